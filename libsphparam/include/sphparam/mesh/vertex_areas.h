#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The area of each vertex: a third of that of the triangles about it. Requires: faces name
/// vertices that are there.
VectorX vertex_areas(const TriangleMesh& mesh);

}  // namespace sphparam
