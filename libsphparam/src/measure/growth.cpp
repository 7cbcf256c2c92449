#include "sphparam/measure/growth.h"

#include <cmath>
#include <stdexcept>

#include "mesh/triangle_geometry.h"

namespace sphparam {
namespace {

VectorX face_areas(const TriangleMesh& mesh) {
  VectorX areas(mesh.face_count());
  for (Face f = 0; f < mesh.face_count(); ++f)
    areas[f] =
        triangle_area(mesh.position(mesh.triangles(f, 0)), mesh.position(mesh.triangles(f, 1)),
                      mesh.position(mesh.triangles(f, 2)));
  return areas;
}

/// What the triangles about each vertex have together.
VectorX about_vertices(const TriangleMesh& mesh, const VectorX& areas) {
  VectorX sums = VectorX::Zero(mesh.vertex_count());
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) sums[mesh.triangles(f, k)] += areas[f];
  return sums;
}

double ratio(double second, double first) {
  const double found = second / first;
  return std::isfinite(found) ? found : 0;
}

VectorX ratios(const VectorX& second, const VectorX& first) {
  VectorX result(first.size());
  for (Eigen::Index i = 0; i < first.size(); ++i) result[i] = ratio(second[i], first[i]);
  return result;
}

}  // namespace

Growth measure_growth(const TriangleMesh& first, const TriangleMesh& second) {
  const bool are_as_many =
      first.vertex_count() == second.vertex_count() && first.face_count() == second.face_count();
  if (!are_as_many || first.triangles != second.triangles)
    throw std::invalid_argument("growth is between surfaces of the same triangles");
  const VectorX before = face_areas(first), after = face_areas(second);
  return {.faces = ratios(after, before),
          .vertices = ratios(about_vertices(second, after), about_vertices(first, before)),
          .total = ratio(after.sum(), before.sum())};
}

}  // namespace sphparam
