#include "mesh/handles/loop_side.h"

#include <Eigen/Geometry>

// The disc leaves the loop along the change of its area: in the plane of the loop's mean normal N
// (Newell's), from vertex v inwards along N × (next − previous). Outside is where that goes along
// the normals of the faces about v.

namespace sphparam {
namespace {

Vector3 doubled_normal(const Topology& topology, const std::vector<Vector3>& places, Vertex v) {
  Vector3 normal = Vector3::Zero();
  topology.for_each_outgoing(v, [&](Halfedge h) {
    normal += (places[topology.target(h)] - places[v]).cross(places[topology.apex(h)] - places[v]);
  });
  return normal;
}

}  // namespace

bool spans_outside(const Topology& topology, const std::vector<Vector3>& places,
                   const std::vector<Vertex>& loop) {
  const size_t n = loop.size();
  const auto place = [&](size_t i) { return places[loop[i % n]]; };
  Vector3 across = Vector3::Zero();
  for (size_t i = 0; i < n; ++i) {
    across += (place(i) - place(0)).cross(place(i + 1) - place(0));
  }
  double outwards = 0;
  for (size_t i = 0; i < n; ++i) {
    const Vector3 inwards = across.cross(place(i + 1) - place(i + n - 1));
    outwards += inwards.dot(doubled_normal(topology, places, loop[i]).normalized());
  }
  return outwards > 0;
}

}  // namespace sphparam
