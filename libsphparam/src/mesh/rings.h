#pragma once

#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// These vertices, then all that are at most `rings` edges away from one, ring by ring, each once.
/// Throws: std::invalid_argument for what is no vertex, or rings < 0.
/// Cost: O(#V) to mark them, and their stars.
std::vector<Vertex> rings_in_order(const Topology& topology, const std::vector<Vertex>& vertices,
                                   int rings);

/// The same in ascending order.
std::vector<Vertex> rings_around(const Topology& topology, const std::vector<Vertex>& vertices,
                                 int rings);

/// The vertices of these faces, in ascending order.
std::vector<Vertex> vertices_of(const Topology& topology, const std::vector<Face>& faces);

}  // namespace sphparam
