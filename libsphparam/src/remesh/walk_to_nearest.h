#pragma once

#include <utility>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// From a face to the nearest of those that share a vertex with it, until none is nearer: that
/// face, and what `on_face(face)` says of it. `is_nearer(place, face, best, best_face)` compares
/// such; of several that are as near to it the one at hand is kept, then the first.
template <class OnFace, class IsNearer>
auto walk_to_nearest(const Topology& topology, Face start, const OnFace& on_face,
                     const IsNearer& is_nearer) {
  std::pair best(start, on_face(start));
  for (Face from = -1; from != best.first;) {
    from = best.first;
    for (int k = 0; k < 3; ++k) {
      topology.for_each_outgoing(topology.vertex(from, k), [&](Halfedge h) {
        const Face face = Topology::face(h);
        const auto place = on_face(face);
        if (is_nearer(place, face, best.second, best.first)) best = {face, place};
      });
    }
  }
  return best;
}

}  // namespace sphparam
