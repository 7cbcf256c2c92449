#pragma once

#include <vector>

#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

/// A rotation of the sphere, and how well functions agree once one is turned by it.
struct TurnOfFunctions {
  Eigen::Matrix3d rotation;
  double correlation = 0;  // −1 to 1: mean of the functions' own
};

/// Rotations R at which k functions f, turned, g(u) = f(Rᵀu), agree most with k others: local
/// maxima of the mean of their correlations over the sphere, means left out, the greatest first.
///
/// All rotations are looked at, on a grid of Euler angles that is finer than twice what functions
/// of degree 12 can tell; the maxima there, at least 20° apart, are then brought to those of all
/// degrees by Newton steps. Requires: coefficients of one degree ≥ 1 and as many columns, of
/// functions that are not constant; most ≥ 1. Throws: std::invalid_argument if not. Ensures: at
/// least one, at most `most`; a function that is another one turned, and has no symmetry, is found
/// with a correlation of 1 up to rounding. Cost: about 30 ms. Source: the correlation on Euler
/// angles: Kostelec and Rockmore, "FFTs on the rotation group" (2008), here by matrix products;
/// turns about y by turns about z between two fixed ones: Risbo, "Fourier transform summation of
/// Legendre series and D-functions" (1996).
std::vector<TurnOfFunctions> turns_by_correlation(const Functions& from, const Functions& to,
                                                  int most = 8, int threads = 0);

/// Functions that are known on parts of the sphere, as harmonics: 1 where each is known, its values
/// and their squares there; 0 elsewhere. A column a function.
struct PartlyKnown {
  Functions known, values, squares;
};

/// Rotations at which functions agree most that are compared where both are known alone: the
/// greatest on the grid, at least 20° apart, the greatest first. Left out are those at which the
/// parts share less than half of the smaller one, or a function is constant on what they share.
///
/// Requires: as `turns_by_correlation`, of all six. Throws: std::invalid_argument if not. Ensures:
/// at most `most`; perhaps none. Cost: about 0.2 s a function. Source: Padfield, "Masked object
/// registration in the Fourier domain" (2012), on Euler angles.
std::vector<TurnOfFunctions> turns_by_shared_correlation(const PartlyKnown& from,
                                                         const PartlyKnown& to, int most = 8,
                                                         int threads = 0);

}  // namespace sphparam
