#pragma once

#include "sphparam/mesh/surface_point.h"

namespace sphparam {

/// Σ barycentricᵢ · row of corner i: the value at a point of a surface whose vertices have the
/// rows; of its positions, where the point is.
inline Vector3 interpolate(const Points& rows, const Triangles& triangles,
                           const SurfacePoint& point) {
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    sum += point.barycentric[k] * rows.row(triangles(point.face, k)).transpose();
  }
  return sum;
}

}  // namespace sphparam
