#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Throws: VertexAtCentre.
void require_directions(const TriangleMesh& mesh, const Vector3& centre);

}  // namespace sphparam
