#include "edge_graph.h"

#include <limits>

// Dijkstra with a 4-ary heap and no decrease-key: an improved vertex is pushed again and its stale
// entries are skipped. The frontier is a front of about √#V vertices, so the heap stays in cache;
// what costs is the walk over the neighbours, hence the flat arrays.

namespace sphparam {
namespace {

struct Entry {
  double distance;
  Vertex vertex;
};

class Heap {
 public:
  bool empty() const { return entries_.empty(); }

  void push(Entry entry) {
    size_t hole = entries_.size();
    entries_.push_back(entry);
    for (; hole > 0; hole = (hole - 1) / 4) {
      const Entry& parent = entries_[(hole - 1) / 4];
      if (parent.distance <= entry.distance) break;
      entries_[hole] = parent;
    }
    entries_[hole] = entry;
  }

  Entry pop() {
    const Entry top = entries_.front();
    const Entry last = entries_.back();
    entries_.pop_back();
    const size_t size = entries_.size();
    if (size == 0) return top;
    size_t hole = 0;
    for (size_t child = 1; child < size; child = 4 * hole + 1) {
      size_t least = child;
      for (size_t c = child + 1; c < child + 4 && c < size; ++c) {
        if (entries_[c].distance < entries_[least].distance) least = c;
      }
      if (entries_[least].distance >= last.distance) break;
      entries_[hole] = entries_[least];
      hole = least;
    }
    entries_[hole] = last;
    return top;
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace

EdgeGraph::EdgeGraph(const TriangleMesh& mesh, const Topology& topology)
    : start_(static_cast<size_t>(topology.vertex_count()) + 1, 0),
      neighbour_(static_cast<size_t>(topology.halfedge_count())),
      length_(neighbour_.size()) {
  const Halfedge count = topology.halfedge_count();
  for (Halfedge h = 0; h < count; ++h) ++start_[static_cast<size_t>(topology.origin(h)) + 1];
  for (size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
  std::vector<int> fill(start_.begin(), start_.end() - 1);
  for (Halfedge h = 0; h < count; ++h) {
    const Vertex a = topology.origin(h), b = topology.target(h);
    const size_t entry = static_cast<size_t>(fill[static_cast<size_t>(a)]++);
    neighbour_[entry] = b;
    length_[entry] = (mesh.position(b) - mesh.position(a)).norm();
  }
}

EdgeGraph::Paths EdgeGraph::shortest_paths(Vertex source, Vertex target) const {
  Paths paths;
  paths.distance.assign(start_.size() - 1, std::numeric_limits<double>::infinity());
  paths.parent.assign(start_.size() - 1, -1);
  paths.distance[static_cast<size_t>(source)] = 0;
  paths.last = source;
  Heap heap;
  heap.push({0, source});
  while (!heap.empty()) {
    const auto [distance, v] = heap.pop();
    if (distance > paths.distance[static_cast<size_t>(v)]) continue;
    paths.last = v;
    if (v == target) break;
    const size_t end = static_cast<size_t>(start_[static_cast<size_t>(v) + 1]);
    for (size_t e = static_cast<size_t>(start_[static_cast<size_t>(v)]); e < end; ++e) {
      const Vertex u = neighbour_[e];
      const double candidate = distance + length_[e];
      if (candidate >= paths.distance[static_cast<size_t>(u)]) continue;
      paths.distance[static_cast<size_t>(u)] = candidate;
      paths.parent[static_cast<size_t>(u)] = v;
      heap.push({candidate, u});
    }
  }
  return paths;
}

}  // namespace sphparam
