#pragma once

namespace sphparam {

// What --json says of the basis, and reads again.

constexpr char orthonormal_basis[] =
    "real, orthonormal on the unit sphere, without the Condon-Shortley phase; row l*l + l + m; "
    "m > 0: cos(m theta), m < 0: sin(|m| theta); Y_11, Y_1-1, Y_10 = sqrt(3/(4 pi)) (x, y, z)";

constexpr char geodetic_basis[] =
    "real, 4pi-normalised, without the Condon-Shortley phase, as in geodesy; row l*l + l + m; "
    "m >= 0: C_lm of cos(m theta), m < 0: S_l|m| of sin(|m| theta); Y_11, Y_1-1, Y_10 = sqrt(3) "
    "(x, y, z)";

}  // namespace sphparam
