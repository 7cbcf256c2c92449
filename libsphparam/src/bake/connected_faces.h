#pragma once

#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Which connected part each face is of: what hangs together by places, which vertices share bit
/// for bit, as those of an artist's mesh do along its seams. Numbered in the order of their first
/// faces. Cost: O(#V + #F), expected.
std::vector<int> parts_of_faces(const TriangleMesh& mesh);

}  // namespace sphparam
