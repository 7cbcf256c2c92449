#pragma once

#include <array>
#include <cmath>
#include <map>
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

/// As a file of STL has it whose writer rounded a share of its corners another way: these are one
/// step of float32 off along each axis, and what is at one place is one vertex.
inline TriangleMesh torn_by_rounding(const TriangleMesh& mesh, double share) {
  std::mt19937 random(11);
  std::map<std::array<float, 3>, Vertex> vertices;
  TriangleMesh torn;
  torn.triangles.resize(mesh.face_count(), 3);
  for (int corner = 0; corner < 3 * static_cast<int>(mesh.face_count()); ++corner) {
    std::array<float, 3> place;
    const bool is_off = static_cast<double>(random()) < share * 0x1p32;
    for (int k = 0; k < 3; ++k) {
      place[k] = static_cast<float>(mesh.positions(mesh.triangles(corner / 3, corner % 3), k));
      if (is_off) place[k] = std::nextafter(place[k], 2.F + place[k]);
    }
    const auto next = static_cast<Vertex>(vertices.size());
    torn.triangles(corner / 3, corner % 3) = vertices.try_emplace(place, next).first->second;
  }
  torn.positions.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (const auto& [place, vertex] : vertices)
    torn.positions.row(vertex) << place[0], place[1], place[2];
  return torn;
}

}  // namespace sphparam::tests
