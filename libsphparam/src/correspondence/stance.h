#pragma once

#include <cmath>

#include "sphparam/mesh/vertex_areas.h"

namespace sphparam {

/// Where the vertices are in space, from the centre of the area, in units of √area. Of two surfaces
/// that lie alike, places that correspond are near each other.
inline Points stance_of(const TriangleMesh& mesh) {
  const VectorX share = vertex_areas(mesh);
  const double area = share.sum();
  const Eigen::RowVector3d centre = share.transpose() * mesh.positions / area;
  return (mesh.positions.rowwise() - centre) / std::sqrt(area);
}

}  // namespace sphparam
