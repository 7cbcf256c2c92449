#include "sphparam/measure/measurable.h"

#include <string>

namespace sphparam {

namespace {

constexpr double least_extent = 1e-60, greatest_extent = 1e60;  // fourth powers are doubles

bool has_area(const TriangleMesh& mesh, double extent) {
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const Vector3 a = mesh.position(mesh.triangles(f, 0));
    const Vector3 b = (mesh.position(mesh.triangles(f, 1)) - a) / extent;
    const Vector3 c = (mesh.position(mesh.triangles(f, 2)) - a) / extent;
    if (b.cross(c).squaredNorm() > 0) return true;
  }
  return false;
}

}  // namespace

void require_measurable(const TriangleMesh& mesh) {
  const double extent =
      (mesh.positions.colwise().maxCoeff() / 2 - mesh.positions.colwise().minCoeff() / 2)
          .maxCoeff() *
      2;
  const bool sized = extent > least_extent && extent < greatest_extent;
  if (sized && has_area(mesh, extent)) return;
  if (extent == 0 || sized) {
    throw UnmeasurableMesh(
        "this mesh can be mapped but not fitted: it has no area, distances to it mean nothing");
  }
  throw UnmeasurableMesh("this mesh can be mapped but not fitted: it is too " +
                         std::string(extent < 1 ? "small" : "large") +
                         ", its extent is not between 1e-60 and 1e60; scale it");
}

double diagonal_of(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

}  // namespace sphparam
