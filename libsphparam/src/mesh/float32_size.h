#pragma once

#include <string>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Smaller meshes lose more in numbers of 32 bits than one of length 1 does, the more so where
/// programs take the smallest of these for zero.
constexpr double least_float32_size = 1e-31;

/// Throws UnmeasurableMesh, `what` first, where the box about the positions is not a point and its
/// longest side is less than `least`.
void require_float32_least(const Points& positions, const std::string& what,
                           double least = least_float32_size);

/// The same where the side is less than `least` or more than its reciprocal.
void require_float32_size(const Points& positions, const std::string& what,
                          double least = least_float32_size);

}  // namespace sphparam
