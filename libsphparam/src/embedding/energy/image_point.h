#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A point with one spare double, so that it never crosses a cache line.
struct alignas(32) ImagePoint {
  double x, y, z, spare;

  Vector3 vector() const { return {x, y, z}; }
};

inline ImagePoint image_point(const Vector3& p) { return {p.x(), p.y(), p.z(), 0}; }

}  // namespace sphparam
