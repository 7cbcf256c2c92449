#pragma once

#include <algorithm>
#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// The faces at some vertices, ascending, each once. Cost: the valences, and to sort.
template <class Vertices>
std::vector<Face> faces_around(const Topology& topology, const Vertices& vertices) {
  std::vector<Face> faces;
  for (const Vertex v : vertices)
    topology.for_each_outgoing(v, [&](Halfedge h) { faces.push_back(Topology::face(h)); });
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}  // namespace sphparam
