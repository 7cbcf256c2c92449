#pragma once

#include <string>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tools {

/// Why two meshes are not one connectivity, the same vertices in every triangle, for people; empty
/// when they are. Triangles may be rotated. `source` is the mesh, `sphere` what should be its
/// sphere.
std::string connectivity_difference(const TriangleMesh& source, const TriangleMesh& sphere);

}  // namespace sphparam::tools
