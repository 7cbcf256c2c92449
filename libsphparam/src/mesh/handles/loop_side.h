#pragma once

#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Whether a disc that spans the loop lies on the side that the faces' normals point to, beside the
/// loop: outside, where they do. About a handle it lies inside, about a tunnel outside.
bool spans_outside(const Topology& topology, const std::vector<Vector3>& places,
                   const std::vector<Vertex>& loop);

}  // namespace sphparam
