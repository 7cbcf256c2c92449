#include "measure/measurable_side.h"

namespace sphparam {

void require_measurable(const TriangleMesh& mesh, Side side) {
  if (mesh.face_count() == 0) throw UnmeasurableSurface(side, "there are no triangles to measure");
  if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= mesh.vertex_count())
    throw UnmeasurableSurface(side, "a triangle names a vertex that is not there");
  if (!mesh.positions.allFinite()) {
    throw UnmeasurableSurface(side, "a coordinate is not a finite number");
  }
}

}  // namespace sphparam
