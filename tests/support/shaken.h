#pragma once

#include <random>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// Triangles that share no vertices, each corner off by up to `error` diagonals of the box along
/// each axis.
inline TriangleMesh shaken_apart(const TriangleMesh& mesh, double error) {
  std::mt19937 random(7);
  const auto somewhere = [&] { return static_cast<double>(random()) / 0x1p31 - 1; };
  const double size =
      (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
  TriangleMesh apart;
  apart.positions.resize(3 * mesh.face_count(), 3);
  apart.triangles.resize(mesh.face_count(), 3);
  for (int corner = 0; corner < 3 * static_cast<int>(mesh.face_count()); ++corner) {
    const double x = somewhere(), y = somewhere(), z = somewhere();
    apart.positions.row(corner) = mesh.positions.row(mesh.triangles(corner / 3, corner % 3)) +
                                  size * error * Eigen::RowVector3d(x, y, z);
    apart.triangles(corner / 3, corner % 3) = corner;
  }
  return apart;
}

}  // namespace sphparam::tests
