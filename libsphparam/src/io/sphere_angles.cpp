#include "io/sphere_angles.h"

#include "sphparam/sphere/spherical_coordinates.h"

namespace sphparam {

std::optional<SphereMap> read_angles(const MeshFile& file) {
  const Property* const theta = file.find_vertex_property("theta");
  const Property* const phi = file.find_vertex_property("phi");
  if (!theta || !phi) return std::nullopt;
  SphereMap map{Points(file.mesh.vertex_count(), 3)};
  for (Eigen::Index v = 0; v < map.points.rows(); ++v)
    map.points.row(v) = to_cartesian({theta->values[v], phi->values[v]});
  return map;
}

}  // namespace sphparam
