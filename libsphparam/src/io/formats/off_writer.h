#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// A text OFF in shortest round-trip doubles: positions and, named by the keyword, normals, colours
/// and texture coordinates of vertices; face colours; comments, last.
std::string serialise_off(const MeshFile& file);

}  // namespace sphparam
