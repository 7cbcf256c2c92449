#include "sphparam/sphere/radial_directions.h"

#include <cmath>
#include <string>

#include "sphere/required_directions.h"

namespace sphparam {
namespace {

/// Of unit length. A power of two keeps squares of what is very large or small in range; halves
/// keep the difference of two very large numbers there. Requires: a ≠ b, finite.
Vector3 direction_between(const Vector3& a, const Vector3& b) {
  Vector3 d = b - a;
  if (!d.allFinite()) d = b / 2 - a / 2;
  const int exponent = std::ilogb(d.cwiseAbs().maxCoeff());
  for (double& x : d) x = std::ldexp(x, -exponent);
  return d.normalized();
}

}  // namespace

VertexAtCentre::VertexAtCentre(Vertex vertex)
    : std::invalid_argument("vertex " + std::to_string(vertex) +
                            " lies at the centre: it has no direction from there"),
      vertex_(vertex) {}

void require_directions(const TriangleMesh& mesh, const Vector3& centre) {
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.position(v) == centre) throw VertexAtCentre(v);
  }
}

SphereMap radial_directions(const TriangleMesh& mesh, const Vector3& centre) {
  if (!centre.allFinite() || !mesh.positions.allFinite()) {
    throw std::invalid_argument("directions are of finite positions from a finite centre");
  }
  require_directions(mesh, centre);
  SphereMap map{Points(mesh.vertex_count(), 3)};
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    map.points.row(v) = direction_between(centre, mesh.position(v));
  }
  return map;
}

}  // namespace sphparam
