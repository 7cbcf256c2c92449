#include "remesh/grid_domain.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "sphparam/mesh/mesh_defects.h"

namespace sphparam {

Triangles as_triangles(const Polygons& faces) {
  std::int64_t count = 0;
  for (std::int64_t f = 0; f < faces.count(); ++f) count += faces.degree(f) - 2;
  Triangles triangles(count, 3);
  std::int64_t t = 0;
  for (std::int64_t f = 0; f < faces.count(); ++f) {
    const auto corners = faces.polygon(f);
    for (size_t k = 2; k < corners.size(); ++k) {
      triangles.row(t++) << corners[0], corners[k - 1], corners[k];
    }
  }
  return triangles;
}

void require_domain(const SphereGrid& grid) {
  const Points& rays = grid.directions;
  for (std::int64_t f = 0; f < grid.faces.count(); ++f) {
    if (grid.faces.degree(f) >= 3) continue;
    throw std::invalid_argument("grid " + grid.name + ": face " + std::to_string(f) +
                                " has less than three corners");
  }
  const bool joined = grid.faces.count() > 0 && std::ranges::all_of(grid.faces.corners, [&](int v) {
                        return v >= 0 && v < rays.rows();
                      });
  if (!joined) throw MeshError(inspect_mesh({rays, as_triangles(grid.faces)}).defects);
  for (Eigen::Index v = 0; v < rays.rows(); ++v) {
    if (rays.row(v).allFinite() && !rays.row(v).isZero(0)) continue;
    throw std::invalid_argument("grid " + grid.name + ": direction " + std::to_string(v) +
                                " is zero or not finite");
  }
}

}  // namespace sphparam
