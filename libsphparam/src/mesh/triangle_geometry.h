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

inline double face_area(const TriangleMesh& mesh, Face face) {
  const auto corner = [&](int k) { return mesh.position(mesh.triangles(face, k)); };
  return triangle_area(corner(0), corner(1), corner(2));
}
/// The sum is in the order of the faces.
inline double surface_area(const TriangleMesh& mesh) {
  double area = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) area += face_area(mesh, f);
  return area;
}

}  // namespace sphparam
