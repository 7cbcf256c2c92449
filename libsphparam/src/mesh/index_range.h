#pragma once

#include <limits>
#include <stdexcept>
#include <string>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Whether the indices of the faces are 1 to #V: counted from one, every corner of the mesh is
/// another vertex than was meant. Nothing that is done to such a mesh mends it. Cost: one pass.
inline bool counts_from_one(const TriangleMesh& mesh) {
  const Triangles& triangles = mesh.triangles;
  return triangles.size() > 0 && triangles.minCoeff() == 1 &&
         triangles.maxCoeff() == mesh.positions.rows();
}

/// Half-edges are numbered by ints, 3·face + corner.
constexpr Eigen::Index most_faces = std::numeric_limits<int>::max() / 3;

/// Throws: std::length_error for more faces or vertices than have numbers.
inline void require_numbered(Eigen::Index faces, Eigen::Index vertices) {
  constexpr Eigen::Index most = std::numeric_limits<int>::max();
  if (faces <= most_faces && vertices <= most) return;
  throw std::length_error("a mesh of " + std::to_string(faces) + " faces and " +
                          std::to_string(vertices) + " vertices: of faces " +
                          std::to_string(most_faces) + " have numbers, of vertices " +
                          std::to_string(most) + "; make it coarser, or take it in parts");
}

/// Whether a face names only vertices that are there.
inline bool is_inside(const Triangles& triangles, Face f, Eigen::Index vertices) {
  return triangles.row(f).minCoeff() >= 0 && triangles.row(f).maxCoeff() < vertices;
}

}  // namespace sphparam
