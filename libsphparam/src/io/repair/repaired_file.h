#pragma once

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/mesh_repair.h"

namespace sphparam {

/// The mesh file with its mesh mended, and everything it carried taken along.
///
/// Created vertices get the mean of the attributes of those they lie between, corners on a side
/// that was split the mean of its ends, new faces and corners those of a neighbour; of texture see
/// `texture_patches`; normals turn with their faces (`turn_normals`). `source_vertex` and
/// `source_face` name the ids of the file, −1 where there is none; vertices and faces that were as
/// they are now keep theirs. The same file when nothing was done.
///
/// Requires: `repaired` was made from `file.mesh`. Cost: O(#V + #F) a property.
MeshFile repaired_file(const MeshFile& file, const RepairedMesh& repaired);

}  // namespace sphparam
