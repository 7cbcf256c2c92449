#pragma once

#include "support/test_meshes.h"

namespace sphparam::tests {

/// The projective plane, of six vertices, after one that no face uses: no repair makes it a sphere.
inline TriangleMesh projective_plane() {
  TriangleMesh plane;
  plane.positions = icosphere(0).positions.topRows(7);
  plane.triangles = Triangles{{1, 2, 3}, {1, 3, 4}, {1, 4, 5}, {1, 5, 6}, {1, 6, 2},
                              {2, 3, 5}, {3, 4, 6}, {4, 5, 2}, {5, 6, 3}, {6, 2, 4}};
  return plane;
}

}  // namespace sphparam::tests
