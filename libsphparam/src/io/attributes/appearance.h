#pragma once

#include <optional>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

// What a mesh file says of how its mesh looks.

/// Whether a file has texture coordinates, at corners or as s, t of vertices.
bool has_texcoords(const MeshFile& file);

/// Texture coordinates of the corners, t upwards: the file's own, else those of the vertices there;
/// nothing where there are none.
std::optional<CornerTexcoords> texcoords_of(const MeshFile& file);

/// What stands for 1 in a colour of this type: 65535 in uint16, 255 in other whole numbers.
double brightest(ScalarType type);

/// #V×3 colours of the vertices, in sRGB, 1 the brightest of their type; nothing where there are
/// none.
std::optional<Points> vertex_colours(const MeshFile& file);

}  // namespace sphparam
