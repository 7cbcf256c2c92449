#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

struct TrianglePoint {
  Vector3 barycentric;
  double squared_distance;
};

/// The point of a triangle nearest to p.
///
/// Of the projection onto the plane, where it falls inside, and the nearest point of each side, the
/// nearest wins. Every candidate is a point of the triangle whatever rounding did to its weights,
/// so no sliver seems nearer than it is; needles, and triangles that are a segment or a point, are
/// found by their sides. Our own: the usual decision by regions divides by a zero area.
/// Requires: finite coordinates whose squares do not overflow.
TrianglePoint nearest_on_triangle(const Vector3& p, const Vector3& a, const Vector3& b,
                                  const Vector3& c);

}  // namespace sphparam
