#include "sphparam/curvilinear/date_line.h"

#include <algorithm>

#include "edge_graph.h"

// Shortest: Dijkstra over edge lengths from north to south. Induced: breadth first over the
// vertices of the path alone; a path with the fewest edges has no chord among them.

namespace sphparam {
namespace {

/// Positions of vertices in a path, by vertex.
class PathIndex {
 public:
  explicit PathIndex(const std::vector<Vertex>& path) {
    for (size_t i = 0; i < path.size(); ++i) entries_.push_back({path[i], static_cast<int>(i)});
    std::sort(entries_.begin(), entries_.end());
  }
  /// The position of v, or -1.
  int of(Vertex v) const {
    const auto entry = std::lower_bound(entries_.begin(), entries_.end(), std::pair(v, -1));
    return entry != entries_.end() && entry->first == v ? entry->second : -1;
  }

 private:
  std::vector<std::pair<Vertex, int>> entries_;
};

}  // namespace

DateLine shortest_date_line(const TriangleMesh& mesh, const Topology& topology, Poles poles) {
  const EdgeGraph graph(mesh, topology);
  const std::vector<Vertex> parent = graph.shortest_paths(poles.south, poles.north).parent;
  std::vector<Vertex> path;
  for (Vertex v = poles.north; v >= 0; v = parent[static_cast<size_t>(v)]) path.push_back(v);

  // Keep from the last vertex on the north link to the first one after it on the south link.
  const PathIndex index(path);
  int first = 0, last = static_cast<int>(path.size()) - 1;
  topology.for_each_outgoing(
      poles.north, [&](Halfedge h) { first = std::max(first, index.of(topology.target(h))); });
  topology.for_each_outgoing(poles.south, [&](Halfedge h) {
    const int i = index.of(topology.target(h));
    if (i > first) last = std::min(last, i);
  });
  DateLine date_line{{poles.north}};
  date_line.path.insert(date_line.path.end(), path.begin() + first, path.begin() + last + 1);
  date_line.path.push_back(poles.south);
  return date_line;
}

DateLine induced_date_line(const Topology& topology, const DateLine& date_line) {
  const std::vector<Vertex>& path = date_line.path;
  const PathIndex index(path);
  const int north = index.of(path.front()), south = index.of(path.back());
  std::vector<int> next(path.size(), -1);  // towards south
  std::vector<int> queue = {south};
  next[static_cast<size_t>(south)] = south;
  for (size_t i = 0; i < queue.size() && next[static_cast<size_t>(north)] < 0; ++i) {
    topology.for_each_outgoing(path[static_cast<size_t>(queue[i])], [&](Halfedge h) {
      const int neighbour = index.of(topology.target(h));
      if (neighbour < 0 || next[static_cast<size_t>(neighbour)] >= 0) return;
      next[static_cast<size_t>(neighbour)] = queue[i];
      queue.push_back(neighbour);
    });
  }
  DateLine induced;
  for (int i = north; i != south; i = next[static_cast<size_t>(i)]) {
    induced.path.push_back(path[static_cast<size_t>(i)]);
  }
  induced.path.push_back(path.back());
  return induced;
}

bool is_induced(const Topology& topology, const DateLine& date_line) {
  const PathIndex index(date_line.path);
  size_t edges = 0;
  bool chord_free = true;
  for (size_t i = 0; i < date_line.path.size(); ++i) {
    topology.for_each_outgoing(date_line.path[i], [&](Halfedge h) {
      const int j = index.of(topology.target(h));
      if (j < 0) return;
      if (j == static_cast<int>(i) + 1) ++edges;
      if (std::abs(j - static_cast<int>(i)) != 1) chord_free = false;
    });
  }
  return chord_free && edges + 1 == date_line.path.size();
}

}  // namespace sphparam
