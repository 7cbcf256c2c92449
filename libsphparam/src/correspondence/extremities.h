#pragma once

#include <Eigen/Core>
#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// The ends of what sticks out of a surface. Lengths are in units of √area.
struct Extremities {
  std::vector<Vertex> vertices;  // the most prominent first
  Eigen::VectorXd farness;       // mean distance from the surface's points
  Eigen::VectorXd prominence;    // by how much more than on the highest way to an end farther out
  Eigen::MatrixXd distances;     // between them, along the surface
};

/// The maxima of the mean distance along the surface that are prominent enough, at most `most`.
/// Same for any number of threads. Cost: 100 times Dijkstra's.
/// Source: the function is that of Hilaga et al., "Topology matching" (2001).
Extremities find_extremities(const TriangleMesh& mesh, const Topology& topology, int most,
                             int threads = 0);

}  // namespace sphparam
