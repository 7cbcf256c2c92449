#pragma once

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/mesh_repair.h"

namespace sphparam {

/// Turns normals of vertices, corners and faces with the faces that a repair turned over, where
/// they were on the side that these faces had before; normals that were on the other side already
/// stay. A vertex that has faces of both kinds gets its normal to the side of its faces as they run
/// now. Where a normal turns, so does the sign of the bitangent.
/// Requires: `file` is gathered by `repaired`. Cost: O(#V + #F).
void turn_normals(MeshFile& file, const RepairedMesh& repaired);

/// Normals of vertices that a repair created, which are means, are of length 1 again: those that
/// are real numbers, and not 0. Requires: as `turn_normals`. Cost: O(#V).
void make_created_normals_unit(MeshFile& file, const RepairedMesh& repaired);

}  // namespace sphparam
