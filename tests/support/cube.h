#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// Corners of the cube [−1, 1]³, and its faces from outside.
inline TriangleMesh cube() {
  TriangleMesh mesh{Points(8, 3), Triangles(12, 3)};
  for (int v = 0; v < 8; ++v)
    mesh.positions.row(v) << (v & 1 ? 1 : -1), (v & 2 ? 1 : -1), (v & 4 ? 1 : -1);
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6,
      0, 6, 2, 1, 3, 7, 1, 7, 5;
  return mesh;
}

}  // namespace sphparam::tests
