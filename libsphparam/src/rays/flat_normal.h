#pragma once

#include <algorithm>
#include <cmath>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The unit normal of a triangle of any finite size; 0 where it has no area.
inline Vector3 flat_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
  // Halves first: the difference of two large numbers may be none. A power of two, so that squares
  // are numbers and no bit is lost.
  const Vector3 ab = b / 2 - a / 2, ac = c / 2 - a / 2;
  const double size = std::max(ab.cwiseAbs().maxCoeff(), ac.cwiseAbs().maxCoeff());
  if (!(size > 0)) return Vector3::Zero();
  const double scale = std::ldexp(1.0, std::min(1023, -std::ilogb(size)));
  return (scale * ab).cross(scale * ac).stableNormalized();
}

}  // namespace sphparam
