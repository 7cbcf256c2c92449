#pragma once

#include <cmath>
#include <stdexcept>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

// Private to what locates directions.

inline constexpr double most_length = 4;         // |q|₁ of a usable direction
inline constexpr double coarse_triangle = 1e-5;  // Σ dets, above which dot products are weights

/// The direction, scaled by a power of two unless ½ ≤ |q| ≤ 2: nothing over- or underflows, and
/// |q|₁ ≤ most_length. Throws: std::invalid_argument for one that is zero or not finite.
inline Vector3 usable(const Vector3& q) {
  const double square = q.squaredNorm();
  if (square >= 0.25 && square <= 4) return q;
  const double length = q.cwiseAbs().maxCoeff();
  if (!q.allFinite() || length == 0) {
    throw std::invalid_argument("SphereLocator: a direction is zero or not finite");
  }
  return q.unaryExpr([&](double x) { return std::ldexp(x, -1 - std::ilogb(length)); });
}

}  // namespace sphparam
