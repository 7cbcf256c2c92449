#include "correspondence/surface_area.h"

#include <cmath>

#include "mesh/flat_face.h"
#include "sphparam/errors.h"

namespace sphparam {

double surface_area(const TriangleMesh& mesh) {
  double area = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) area += face_area(mesh, f);
  return area;
}

VectorX areas_round_vertices(const TriangleMesh& mesh) {
  VectorX areas = VectorX::Zero(mesh.vertex_count());
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const double third = face_area(mesh, f) / 3;
    for (int k = 0; k < 3; ++k) areas[mesh.triangles(f, k)] += third;
  }
  return areas;
}

Points stance_of(const TriangleMesh& mesh) {
  const VectorX share = areas_round_vertices(mesh);
  const double area = share.sum();
  const Eigen::RowVector3d centre = share.transpose() * mesh.positions / area;
  return (mesh.positions.rowwise() - centre) / std::sqrt(area);
}

void require_area(const MappedMesh& mapped) {
  const double area = surface_area(mapped.surface());
  if (area > 0 && std::isfinite(area)) return;
  throw UnmeasurableMesh(mapped.name() + ": the surface has no area that can be measured");
}

}  // namespace sphparam
