#pragma once

#include <vector>

#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

/// Turns of harmonics about the axes, degree by degree: what `turn_harmonics` does, for many turns.
/// About z a turn mixes cos mθ and sin mθ only; about another axis it is one about z between two
/// turns by a right angle, which are matrices that are made once.
class HarmonicTurns {
 public:
  /// Requires: 0 ≤ degree ≤ greatest_harmonic_degree. Cost: (L + 1)^6 multiplications / 4.
  explicit HarmonicTurns(int degree);

  int degree() const { return static_cast<int>(tilts_.size()) - 1; }
  /// The turn of degree l by −π/2 about x, which takes z to y: (2l + 1)².
  const Eigen::MatrixXd& tilt(int l) const { return tilts_[static_cast<size_t>(l)]; }
  /// The turn of degree l by β about y.
  Eigen::MatrixXd about_y(int l, double angle) const;
  /// What turns about x, y, z make of functions in the first instant: d/dφ at 0.
  Functions generator(int axis, const Functions& coefficients) const;

 private:
  enum class Way { There, Back };
  Functions tilted(Functions c, Way way) const;

  std::vector<Eigen::MatrixXd> tilts_;
};

}  // namespace sphparam
