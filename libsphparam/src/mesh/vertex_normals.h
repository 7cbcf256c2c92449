#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Unit normals, the mean of the faces' weighted by area; +z where that is zero. #V×3.
/// Requires: finite positions, of any size.
Points vertex_normals(const TriangleMesh& mesh);

}  // namespace sphparam
