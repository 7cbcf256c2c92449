#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Comma-separated values, a row a vertex: its number, theta and phi (radians), x y z, and every
/// property of vertices; shortest text that reads back the same.
std::string sample_table(const MeshFile& file, const SphereMap& map);

}  // namespace sphparam
