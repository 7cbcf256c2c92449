#pragma once

#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// The edges of a mesh with their lengths, laid out vertex by vertex for shortest paths.
class EdgeGraph {
 public:
  /// Cost: O(#F), 36 bytes a triangle.
  EdgeGraph(const TriangleMesh& mesh, const Topology& topology);

  struct Paths {
    std::vector<double> distance;  // #V: from the source; infinite where not reached
    std::vector<Vertex> parent;    // #V: the vertex before on a shortest path; -1 at the source
    Vertex last;                   // the last vertex settled: farthest, or the target
  };

  /// Dijkstra's algorithm from `source`, until `target` is settled (-1: all vertices).
  Paths shortest_paths(Vertex source, Vertex target = -1) const;

 private:
  std::vector<int> start_;         // #V+1
  std::vector<Vertex> neighbour_;  // grouped by vertex
  std::vector<double> length_;
};

}  // namespace sphparam
