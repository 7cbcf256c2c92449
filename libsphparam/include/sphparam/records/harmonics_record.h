#pragma once

#include <string>

#include "sphparam/io/harmonic_expansion.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam {

/// All coefficients and residuals, as `sphparam spharm --json` tells them. `mesh`: its file; `map`:
/// the provenance of the map that was used.
std::string to_json(const HarmonicExpansion& expansion, const std::string& mesh,
                    const Provenance& map);

/// One line a coefficient: l, m, then one number a function; a header line first. Numbers come back
/// exactly.
std::string to_csv(const HarmonicExpansion& expansion);

}  // namespace sphparam
