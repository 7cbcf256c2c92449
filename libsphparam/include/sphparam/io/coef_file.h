#pragma once

#include <string>
#include <string_view>

#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

// Files *.coef of SPHARM-PDM: "{ 169,{x, y, z},", a line a coefficient, "}". Coefficients of degree
// l stand at l² + … : m = 0; then cos mθ and sin mθ for m = 1 … l. They belong to N_lm P_l^m(cosϕ)
// cos mθ with the Condon–Shortley phase and without √2 (N_lm as in spherical_harmonics.h), so that
// those of m > 0 are (−1)^m √2 times ours. Source: the writer and the reader of SPHARM-PDM.

/// Ensures: numbers come back exactly but for the rounding of √2. Requires: three columns at least;
/// further ones are left out.
std::string to_coef(const Functions& coefficients);

/// x, y, z in our basis.
/// Throws: ReadError with the line; also where their number is no (L + 1)², L ≤
/// greatest_harmonic_degree.
Functions read_coef(const std::string& path);
/// The same from text in memory; `name` is for messages.
Functions parse_coef(std::string_view text, const std::string& name);

}  // namespace sphparam
