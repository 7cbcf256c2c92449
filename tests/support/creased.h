#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam::tests {

/// Normals of corners as artists' programs make them: the mean of those faces about the vertex that
/// are turned from the corner's own by less than `degrees`, so that steeper edges are hard.
inline CornerNormals creased_normals(const TriangleMesh& mesh, double degrees) {
  const Eigen::Index faces = mesh.face_count();
  Points flat(faces, 3);
  std::vector<std::vector<Eigen::Index>> about(static_cast<size_t>(mesh.vertex_count()));
  for (Eigen::Index f = 0; f < faces; ++f) {
    const auto corner = [&](int k) { return mesh.position(mesh.triangles(f, k)); };
    flat.row(f) = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    for (int k = 0; k < 3; ++k) about[static_cast<size_t>(mesh.triangles(f, k))].push_back(f);
  }
  const double least = std::cos(degrees * std::numbers::pi / 180);
  CornerNormals normals = CornerNormals::Zero(3 * faces, 3);
  for (Eigen::Index corner = 0; corner < normals.rows(); ++corner) {
    for (const Eigen::Index f : about[static_cast<size_t>(mesh.triangles.data()[corner])])
      if (flat.row(f).dot(flat.row(corner / 3)) > least) normals.row(corner) += flat.row(f);
    normals.row(corner).normalize();
  }
  return normals;
}

}  // namespace sphparam::tests
