#pragma once

#include <vector>

#include "sphparam/mesh/surface_point.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Paths along the edges of a surface and straight across pairs of triangles: their lengths are
/// some per cent above the geodesic distance, never below it. Borrows the mesh.
class SurfaceRoads {
 public:
  SurfaceRoads(const TriangleMesh& mesh, const Topology& topology);

  /// From `from` to each vertex until all of `until` are reached; all, where it is empty. +∞: not
  /// reached. Cost: Dijkstra's.
  std::vector<double> distances(Vertex from, std::vector<Vertex> until = {}) const;
  /// To a point of the surface.
  double distance(Vertex from, const SurfacePoint& to) const;

 private:
  struct Way {
    Vertex to;
    double length;
  };

  void add_crossing(const Topology& topology, Vertex from, Halfedge edge);

  const TriangleMesh& mesh_;
  std::vector<Way> ways_;
  std::vector<size_t> start_;
};

}  // namespace sphparam
