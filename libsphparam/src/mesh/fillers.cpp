#include "sphparam/mesh/fillers.h"

#include <algorithm>

namespace sphparam {

TriangleMesh surface_of(const TriangleMesh& mesh, const FillerMarks& fillers) {
  if (fillers.empty()) return mesh;
  const auto kept = std::count(fillers.begin(), fillers.end(), 0);
  TriangleMesh surface{mesh.positions, Triangles(kept, 3)};
  Eigen::Index next = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    if (!fillers[f]) surface.triangles.row(next++) = mesh.triangles.row(f);
  }
  return surface;
}

TriangleMesh surface_in_place(const TriangleMesh& mesh, const FillerMarks& fillers) {
  TriangleMesh surface = mesh;
  const auto first = std::find(fillers.begin(), fillers.end(), 0) - fillers.begin();
  for (Eigen::Index f = 0; f < std::ssize(fillers); ++f) {
    if (fillers[f]) surface.triangles.row(f).setConstant(mesh.triangles(first, 0));
  }
  return surface;
}

}  // namespace sphparam
