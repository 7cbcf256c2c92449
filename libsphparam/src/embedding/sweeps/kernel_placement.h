#pragma once

#include <optional>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A point well inside the kernel of a spherical polygon, from where all its edges are seen
/// counter-clockwise; nothing if rounding leaves no such point.
/// ring: at least three points, counter-clockwise. Cost: linear in expectation, O(k³) at worst.
std::optional<Vector3> place_in_kernel(const std::vector<Vector3>& ring);

}  // namespace sphparam
