#pragma once

#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// These faces, and the vertices that they use, in the order they have, with all that the file
/// carries. Requires: ascending faces.
MeshFile part_of(const MeshFile& file, const std::vector<Face>& faces);

/// The file with `source_vertex` and `source_face`, from 0, where it has not got them: what is
/// taken apart afterwards keeps the numbers of the file.
MeshFile with_numbers(MeshFile file);

/// `try_repair` of one part of a mesh, which nothing welds: all are mended in one way.
RepairTrial try_part(const MeshSource& part);

}  // namespace sphparam
