#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Whether the indices of the faces are 1 to #V: counted from one, every corner of the mesh is
/// another vertex than was meant. Nothing that is done to such a mesh mends it. Cost: one pass.
inline bool counts_from_one(const TriangleMesh& mesh) {
  const Triangles& triangles = mesh.triangles;
  return triangles.size() > 0 && triangles.minCoeff() == 1 &&
         triangles.maxCoeff() == mesh.positions.rows();
}

/// Whether a face names only vertices that are there.
inline bool is_inside(const Triangles& triangles, Face f, Eigen::Index vertices) {
  return triangles.row(f).minCoeff() >= 0 && triangles.row(f).maxCoeff() < vertices;
}

}  // namespace sphparam
