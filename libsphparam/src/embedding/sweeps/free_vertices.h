#pragma once

#include <optional>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The vertices that may move: `vertices` (all, if not given) without repetitions and without
/// `pinned`, in their order.
std::vector<Vertex> free_vertices(int vertex_count,
                                  const std::optional<std::vector<Vertex>>& vertices,
                                  const std::vector<Vertex>& pinned);

}  // namespace sphparam
