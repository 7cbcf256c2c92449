#pragma once

#include <Eigen/Geometry>

#include "elementary.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// 0 to π, exact to rounding: an arc cosine would lose small angles. 0 where a vector is zero: its
/// product may be −0, where the angle would be π.
inline double angle_between(const Vector3& a, const Vector3& b) {
  return elementary::atan2(a.cross(b).norm(), a.dot(b) + 0.0);
}

/// Of the triangle abc.
inline double doubled_area(const Vector3& a, const Vector3& b, const Vector3& c) {
  return (b - a).cross(c - a).norm();
}
inline double triangle_area(const Vector3& a, const Vector3& b, const Vector3& c) {
  return doubled_area(a, b, c) / 2;
}

}  // namespace sphparam
