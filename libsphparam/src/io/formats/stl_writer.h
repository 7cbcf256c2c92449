#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// A binary STL: for each triangle its normal and three corners as float32, little-endian. Numbers
/// of vertices, and all that vertices, faces and corners have, find no place in it; vertices that
/// lie in one place are one to who reads it: `losses_of_own_corners` tells.
/// Throws: WriteError for coordinates beyond the range of float32.
std::string serialise_stl(const MeshFile& file);

}  // namespace sphparam
