#pragma once

#include <optional>

#include "sphparam/io/mesh_file.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// The map that a mesh file carries in theta and phi alone, as glTF by `export --theta-phi` does;
/// nothing if one of them is missing. In numbers of 32 bits it is near the map they are of, and may
/// fold where that does not.
std::optional<SphereMap> read_angles(const MeshFile& file);

}  // namespace sphparam
