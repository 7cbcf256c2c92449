#pragma once

#include <string>
#include <vector>

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

/// For people: "degree 20, RMS distance at the vertices, weighted by solid angle, 0.12 (0.01 % of
/// the diagonal), unweighted 0.13".
std::string residual_line(const HarmonicExpansion& expansion);

/// For people: the first-order ellipsoid, and what is left of each scalar; a line each.
std::vector<std::string> further_lines(const HarmonicExpansion& expansion);

}  // namespace sphparam
