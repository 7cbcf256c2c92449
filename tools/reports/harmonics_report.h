#pragma once

#include <string>

#include "sphparam/io/harmonic_expansion.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam::cli {

/// The report with all coefficients, as the manual describes it. `mesh`: its path; `map`: the
/// provenance of the map that was used.
std::string to_json(const HarmonicExpansion& expansion, const std::string& mesh,
                    const Provenance& map);

/// One line a coefficient: l, m, then one number a function; a header line first. Numbers come back
/// exactly.
std::string to_csv(const HarmonicExpansion& expansion);

}  // namespace sphparam::cli
