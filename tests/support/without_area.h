#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// A tetrahedron that has collapsed into a line: closed, and without any area.
inline TriangleMesh collapsed_tetrahedron() {
  TriangleMesh mesh{Points(4, 3), Triangles(4, 3)};
  mesh.positions << 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0;
  mesh.triangles << 0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2;
  return mesh;
}

}  // namespace sphparam::tests
