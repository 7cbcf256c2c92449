#pragma once

#include "sphparam/mesh/mesh_defects.h"

namespace sphparam {

/// Throws MeshError with every defect of the mesh that stands in the way of a map, unused vertices
/// among them. Cost: that of an inspection.
[[noreturn]] void refuse_mesh(const TriangleMesh& mesh);

}  // namespace sphparam
