#pragma once

#include <optional>

#include "io/attributes/appearance.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// #V×3 colours of the vertices in linear light, which a mesh has in sRGB; nothing where there
/// are none.
std::optional<Points> linear_colours(const MeshFile& file);

}  // namespace sphparam
