#include "sphere/solid_angle.h"

namespace sphparam {

VectorX vertex_solid_angles(const Topology& topology, const SphereMap& map) {
  VectorX shares = VectorX::Zero(topology.vertex_count());
  for (Face f = 0; f < topology.face_count(); ++f) {
    const double angle =
        solid_angle(map.point(topology.vertex(f, 0)), map.point(topology.vertex(f, 1)),
                    map.point(topology.vertex(f, 2)));
    for (int k = 0; k < 3; ++k) shares[topology.vertex(f, k)] += angle / 3;
  }
  return shares;
}

}  // namespace sphparam
