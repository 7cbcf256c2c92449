#include "sphparam/mesh/vertex_areas.h"

#include "mesh/triangle_geometry.h"

namespace sphparam {

VectorX vertex_areas(const TriangleMesh& mesh) {
  VectorX areas = VectorX::Zero(mesh.vertex_count());
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const double third = face_area(mesh, f) / 3;
    for (int k = 0; k < 3; ++k) areas[mesh.triangles(f, k)] += third;
  }
  return areas;
}

}  // namespace sphparam
