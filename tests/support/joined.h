#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// Two meshes as one, the second one moved.
inline TriangleMesh joined(const TriangleMesh& first, const TriangleMesh& second,
                           const Vector3& movement = Vector3::Zero()) {
  TriangleMesh both;
  both.positions.resize(first.vertex_count() + second.vertex_count(), 3);
  both.positions << first.positions, second.positions.rowwise() + movement.transpose();
  both.triangles.resize(first.face_count() + second.face_count(), 3);
  both.triangles << first.triangles,
      (second.triangles.array() + static_cast<int>(first.vertex_count())).matrix();
  return both;
}

}  // namespace sphparam::tests
