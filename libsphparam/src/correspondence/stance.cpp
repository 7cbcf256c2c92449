#include "correspondence/stance.h"

#include <cmath>

#include "correspondence/surface_area.h"

namespace sphparam {

Points stance_of(const TriangleMesh& mesh) {
  const VectorX share = areas_round_vertices(mesh);
  const double area = share.sum();
  const Eigen::RowVector3d centre = share.transpose() * mesh.positions / area;
  return (mesh.positions.rowwise() - centre) / std::sqrt(area);
}

}  // namespace sphparam
