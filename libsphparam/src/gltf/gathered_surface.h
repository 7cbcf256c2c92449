#pragma once

#include <vector>

#include "sphparam/gltf/asset.h"

namespace sphparam {

/// The vertices of these numbers, in this order, with all that they have; indices stay as they are.
void keep_vertices(Surface& surface, const std::vector<Eigen::Index>& kept);

}  // namespace sphparam
