#pragma once

#include "sphparam/mesh/topology.h"
#include "sphparam/parameterize.h"

namespace sphparam {

/// Throws: MeshError if a pole, pin or meridian is no vertex; std::invalid_argument if a vertex is
/// pinned twice or two are pinned at one point.
void require_given_vertices(const Topology& topology, const ParameterizeOptions& options);

}  // namespace sphparam
