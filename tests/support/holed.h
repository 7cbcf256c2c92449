#pragma once

#include "sphparam/mesh/triangle_mesh.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

/// A ball without one of its triangles.
inline TriangleMesh with_a_hole() {
  TriangleMesh mesh = icosphere(2);
  mesh.triangles.conservativeResize(mesh.face_count() - 1, 3);
  return mesh;
}

}  // namespace sphparam::tests
