#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Whether the faces of a closed mesh look inward: what they enclose is less than nothing, by more
/// than rounding. Of any size. Requires: a vertex. Cost: a pass over the faces.
bool is_inside_out(const TriangleMesh& mesh);

}  // namespace sphparam
