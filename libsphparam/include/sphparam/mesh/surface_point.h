#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A point of a mesh: Σ barycentricᵢ · (corner i of the face), weights ≥ 0 that sum to 1 up to
/// rounding.
struct SurfacePoint {
  Face face = 0;
  Vector3 barycentric = Vector3::UnitX();
};

/// The weights of the same point at the corners of another face that it lies on: of either face of
/// its edge, of any face of its vertex.
/// Requires: every corner of `point.face` with a weight is a corner of `face`.
inline Vector3 barycentric_in(Face face, const SurfacePoint& point, const Triangles& triangles) {
  if (face == point.face) return point.barycentric;
  Vector3 weights = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (triangles(point.face, i) == triangles(face, k)) weights[k] = point.barycentric[i];
    }
  }
  return weights;
}

}  // namespace sphparam
