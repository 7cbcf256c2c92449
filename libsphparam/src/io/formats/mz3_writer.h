#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// An MZ3 mesh, not packed (a name that ends in .mz3.gz asks for that): triangles, positions as
/// float32, colours as bytes, and each other property of vertices as a layer; of 64 bits where one
/// of them needs that.
/// Names, comments and what faces and corners have find no place in it; positions that are no
/// float32 numbers are rounded: `losses_of_writing` tells.
/// Throws: WriteError for coordinates beyond the range of float32.
std::string serialise_mz3(const MeshFile& file);

}  // namespace sphparam
