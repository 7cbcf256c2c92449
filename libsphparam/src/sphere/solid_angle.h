#pragma once

#include <cmath>

#include "elementary.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Half the signed area of a spherical triangle as an angle: its sine and cosine times a positive
/// number.
struct HalfSolidAngle {
  double sine, cosine;
};
inline HalfSolidAngle half_solid_angle_of(const Vector3& a, const Vector3& b, const Vector3& c) {
  return {a.dot((b - a).cross(c - a)), 1 + a.dot(b) + b.dot(c) + c.dot(a)};
}

/// Signed area of a spherical triangle, in (−2π, 2π): tan(Ω/2) = det(a, b, c) / (1 + a·b + b·c +
/// c·a) for unit rays. The determinant is taken of differences, which keeps small triangles exact.
/// Paper: Van Oosterom and Strackee, "The solid angle of a plane triangle" (1983).
inline double solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const HalfSolidAngle half = half_solid_angle_of(a, b, c);
  return 2 * elementary::atan2(half.sine, half.cosine);
}

/// Each vertex's share of the sphere: a third of its triangles' solid angles. Sums to 4π where the
/// map is one-to-one. Requires: unit rays.
VectorX vertex_solid_angles(const Topology& topology, const SphereMap& map);

}  // namespace sphparam
