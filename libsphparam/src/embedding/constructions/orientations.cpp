#include "embedding/constructions/orientations.h"

#include <atomic>

#include "sphere/face_rays.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

constexpr std::int64_t grain = 8192;

bool is_positive(const Topology& topology, const SphereMap& map, Face f) {
  return face_orientation(topology, map, f) > 0;
}

}  // namespace

bool all_triangles_positive(const Topology& topology, const SphereMap& map, int threads) {
  std::atomic<bool> positive{true};
  parallel_for(topology.face_count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto f = static_cast<Face>(first); f < static_cast<Face>(last) && positive; ++f) {
      if (!is_positive(topology, map, f)) positive = false;
    }
  });
  return positive;
}

bool ring_is_positive(const Topology& topology, const SphereMap& map, Vertex v) {
  bool positive = true;
  topology.for_each_outgoing(
      v, [&](Halfedge h) { positive = positive && is_positive(topology, map, Topology::face(h)); });
  return positive;
}

}  // namespace sphparam
