#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tools {

/// Throws MeshError for a mesh that has a map but no distances: without area, or of a size whose
/// powers doubles cannot hold. (Maps do not depend on size; fits and distances do.)
void require_measurable(const TriangleMesh& mesh);

}  // namespace sphparam::tools
