#pragma once

#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// Where the vertices of a surface are in space, from the centre of its area, in units of √area. Of
/// two surfaces that lie alike, places that correspond are near each other.
Points stance_of(const TriangleMesh& mesh);

}  // namespace sphparam
