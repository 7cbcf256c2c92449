#pragma once

#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// det > 0 for every triangle, decided exactly.
bool all_triangles_positive(const Topology& topology, const SphereMap& map, int threads);

/// The same for the triangles at one vertex.
bool ring_is_positive(const Topology& topology, const SphereMap& map, Vertex v);

}  // namespace sphparam
