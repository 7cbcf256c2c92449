#pragma once

#include <optional>

#include "mesh_io/appearance.h"
#include "mesh_io/mesh_file.h"

namespace sphparam::tools {

/// #V×3 colours of the vertices in linear light, which a mesh has in sRGB; nothing where there
/// are none.
std::optional<Points> linear_colours(const MeshFile& file);

}  // namespace sphparam::tools
