#pragma once

#include <optional>

#include "mesh_io/mesh_file.h"

namespace sphparam::tools {

/// Texture coordinates of the corners, t upwards, whether the file has them at corners or vertices.
bool has_texcoords(const MeshFile& file);
std::optional<CornerTexcoords> texcoords_of(const MeshFile& file);

/// #V×3 colours of the vertices in linear light, which a mesh has in sRGB; nothing where there
/// are none.
std::optional<Points> linear_colours(const MeshFile& file);

}  // namespace sphparam::tools
