#pragma once

#include "sphparam/mesh/surface_point.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Calls visit(face) for every face that the point lies on, its own first, until it says true.
template <class Visit>
bool any_face_of(const SurfacePoint& point, const Topology& topology, const Visit& visit) {
  if (visit(point.face)) return true;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, previous = (k + 2) % 3;
    if (point.barycentric[next] == 0 && point.barycentric[previous] == 0) {
      bool found = false;
      topology.for_each_outgoing(topology.vertex(point.face, k),
                                 [&](Halfedge h) { found = found || visit(Topology::face(h)); });
      return found;
    }
    if (point.barycentric[k] == 0) {
      const Face beyond = Topology::face(topology.twin(3 * point.face + next));
      if (point.barycentric[next] != 0 && point.barycentric[previous] != 0) return visit(beyond);
    }
  }
  return false;
}

}  // namespace sphparam
