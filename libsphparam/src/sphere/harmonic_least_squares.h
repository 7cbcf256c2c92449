#pragma once

#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

/// min Σ_v weight_v (f(v) − Y(v) c)², by conjugate gradients, all functions side by side, each with
/// its own steps. Neither Y nor YᵀWY, which is near the identity where triangles are small against
/// a wave, is ever made.
///
/// Where vertices are too few for a wave, YᵀWY has eigenvalues near 0: what is left at the vertices
/// is then fitted with ever larger functions that hardly show there. A function stops before a step
/// of that kind, and is where it came from in all that the vertices leave open. Source: our own;
/// early stops as regularisation: Hansen, "Rank-deficient and discrete ill-posed problems" (1998).
class HarmonicLeastSquares {
 public:
  /// All outlive it.
  HarmonicLeastSquares(const Points& directions, const VectorX& weights, const Functions& values,
                       const HarmonicFitOptions& options)
      : directions_(directions), weights_(weights), values_(values), options_(options) {}

  struct End {
    int iterations;
    bool converged;  // to the tolerance, or to rounding, all functions
  };
  /// From these coefficients, of any degree.
  End solve(Functions& coefficients) const;

  /// What vertices decide.
  struct Decided {
    int degree;
    Functions coefficients;  // of a fit of that degree
  };
  /// The greatest degree below that of `start`, from whose first coefficients they converge without
  /// a step that goes on between the vertices; by bisection.
  Decided decided(const Functions& start) const;

 private:
  End solve(Functions& coefficients, double worth) const;
  Functions transposed(const Functions& values, Eigen::Index harmonics) const;
  Eigen::ArrayXd weighted_squares(const Functions& values) const;
  /// Squares of the gradient with which a function is settled: of its sums with the harmonics, but
  /// where it is none of these, rounding of the function itself.
  Eigen::ArrayXd enough(Eigen::Index harmonics) const;

  const Points& directions_;
  const VectorX& weights_;
  const Functions& values_;
  const HarmonicFitOptions& options_;
};

}  // namespace sphparam
