#include "mesh/rings.h"

#include <algorithm>
#include <utility>

#include "option_domain.h"

// Breadth first, a ring at a time.

namespace sphparam {

std::vector<Vertex> rings_in_order(const Topology& topology, const std::vector<Vertex>& vertices,
                                   int rings) {
  require_vertices("vertices", vertices, topology.vertex_count());
  require_at_least("rings", rings, 0);
  std::vector<char> seen(static_cast<size_t>(topology.vertex_count()), 0);
  std::vector<Vertex> found;
  const auto add = [&](Vertex v) {
    if (!std::exchange(seen[static_cast<size_t>(v)], 1)) found.push_back(v);
  };
  for (const Vertex v : vertices) add(v);
  size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const size_t end = found.size();
    for (; begin < end; ++begin) {
      topology.for_each_outgoing(found[begin], [&](Halfedge h) { add(topology.target(h)); });
    }
  }
  return found;
}

std::vector<Vertex> rings_around(const Topology& topology, const std::vector<Vertex>& vertices,
                                 int rings) {
  std::vector<Vertex> found = rings_in_order(topology, vertices, rings);
  std::ranges::sort(found);
  return found;
}

std::vector<Vertex> vertices_of(const Topology& topology, const std::vector<Face>& faces) {
  std::vector<Vertex> vertices;
  for (const Face f : faces) {
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(topology.vertex(f, corner));
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace sphparam
