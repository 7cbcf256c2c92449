#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Throws: std::invalid_argument unless weights of points are at least 0 and sum to 1, up to
/// rounding.
void require_weights(const VectorX& weights);

}  // namespace sphparam
