#pragma once

#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// How shapes of corresponding points vary: orthogonal directions of most variance.
///
/// A shape is mean + Σ scores(i, k) · modes[k], exactly where all modes are kept: a mode is what
/// one standard deviation adds to each point, a score how many of them a shape has.
struct ShapeModes {
  std::vector<Points> modes;  // #V×3 each, the most variance first
  VectorX deviations;         // of each: RMS displacement by one standard deviation, weighted
  VectorX shares;             // of each: of the variance, 0 to 1
  MatrixX scores;             // shapes × modes; of each mode their mean is 0, their variance 1
  double variance = 0;        // of all modes: Σ |x − mean|² / (shapes − 1), weighted
};

/// Principal components of shapes that are aligned already. The sign of a mode is such that the
/// score of greatest size is positive.
/// Requires: at least one shape; as many points in all, in their mean and in weights, which are at
/// least 0 and sum to 1; most ≥ 0. Throws: std::invalid_argument if not. Ensures: at most shapes −
/// 1 modes, none whose deviation is rounding; the same bits for any number of threads. Source:
/// Cootes et al., "Active shape models" (1995), by the Gram matrix of the shapes.
ShapeModes shape_modes(const std::vector<Points>& shapes, const Points& mean,
                       const VectorX& weights, int most, int threads = 0);

/// The mean and so many standard deviations of a mode. Requires: a mode that there is.
Points along_mode(const Points& mean, const ShapeModes& modes, int mode, double deviations);

}  // namespace sphparam
