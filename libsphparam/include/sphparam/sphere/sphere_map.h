#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A map of a mesh to the sphere: the ray of each vertex, of unit length up to rounding. A triangle
/// maps to the geodesic triangle of its three rays.
struct SphereMap {
  Points points;  // #V×3

  Vector3 point(Vertex v) const { return points.row(v); }
};

/// Divides every ray by its length. Requires: no zero ray.
SphereMap normalised(Points rays);

}  // namespace sphparam
