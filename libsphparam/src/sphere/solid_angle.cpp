#include "sphere/solid_angle.h"

namespace sphparam {

VectorX vertex_solid_angles(const Topology& topology, const SphereMap& map) {
  VectorX shares = VectorX::Zero(topology.vertex_count());
  for (Face f = 0; f < topology.face_count(); ++f) {
    const Vector3 a = map.point(topology.vertex(f, 0)), b = map.point(topology.vertex(f, 1)),
                  c = map.point(topology.vertex(f, 2));
    const double angle =
        2 * elementary::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
    for (int k = 0; k < 3; ++k) shares[topology.vertex(f, k)] += angle / 3;
  }
  return shares;
}

}  // namespace sphparam
