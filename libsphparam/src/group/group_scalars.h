#pragma once

#include <vector>

#include "sphparam/group/group.h"

namespace sphparam {

/// Of the floating numbers that the vertices of two shapes at least have on the grid, in the order
/// in which they are first met; not colours and texture coordinates.
std::vector<GroupScalar> group_scalars(const std::vector<GroupMember>& members);

}  // namespace sphparam
