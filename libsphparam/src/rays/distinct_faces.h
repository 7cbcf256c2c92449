#pragma once

#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Of triangles with the same three places, corner by corner, the first; ascending. Where thousands
/// of vertices lie in one point, thousands of triangles are the same, and all of them would be
/// asked for every nearest point. Meshes without an edge of no length are taken as they are. Cost:
/// O(#F log #F) where there is such an edge, else O(#F).
std::vector<Face> distinct_faces(const TriangleMesh& mesh);

}  // namespace sphparam
