#pragma once

#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/progress.h"

namespace sphparam {

/// How near a wrap comes to what it is about.
struct DrawIn {
  double distance, voxel;  // of the wrap from the soup, and how fine it is
  double gap;              // what is left of the distance
  int threads = 0;
  Progress progress = {};
};

/// Moves the vertices of a wrap that lie at the distance from the soup along their normals, until
/// the gap is left. What is farther away, walls and bridges, stays; what leads there goes part of
/// the way. Ensures: the triangles name the same vertices; the same places for any number of
/// threads. Cost: a few nearest points a vertex, a dozen where sides meet at an angle.
void draw_in(TriangleMesh& wrap, const TriangleMesh& soup, const DrawIn& how);

}  // namespace sphparam
