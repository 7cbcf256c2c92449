#pragma once

#include <cmath>
#include <numbers>

#include "support/test_meshes.h"

namespace sphparam::tests {

/// Hairs from the unit sphere outwards, evenly in all directions: each a closed tube, 10 long and
/// 0.02 thick, of `pieces` from end to end. Thin triangles that lie across all axes.
inline TriangleMesh hedgehog(int hairs, int around, int pieces) {
  const TriangleMesh hair = tube(pieces + 1, around);
  const auto vertices = static_cast<int>(hair.vertex_count()),
             faces = static_cast<int>(hair.face_count());
  TriangleMesh mesh{Points(hairs * vertices, 3), Triangles(hairs * faces, 3)};
  for (int i = 0; i < hairs; ++i) {
    const double z = 1 - (2 * i + 1.0) / hairs, turn = i * std::numbers::pi * (3 - std::sqrt(5.0)),
                 r = std::sqrt(1 - z * z);
    const Vector3 out(r * std::cos(turn), r * std::sin(turn), z);
    const Eigen::Matrix3d frame =
        Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), out).toRotationMatrix();
    for (int v = 0; v < vertices; ++v) {
      const Vector3 p = hair.position(v);
      mesh.positions.row(i * vertices + v) =
          6 * out + frame * Vector3(0.01 * p.x(), 0.01 * p.y(), 10 * p.z() / (pieces + 1));
    }
    mesh.triangles.middleRows(i * faces, faces) = hair.triangles.array() + i * vertices;
  }
  return mesh;
}

}  // namespace sphparam::tests
