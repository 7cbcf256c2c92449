#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// What people and other programs say of the object in comments (an inventory number, a unit, who
/// scanned it): all comments but those that say of the file itself how it is made and to be read
/// (its map, axes, numbers, textures, data attached).
std::vector<std::string> remarks_of(const MeshFile& file);

/// A comment that counts the vertices or faces of a file or says that its lists begin or end, as
/// "4537 vertices, 0 vertices normals" and "End of File" do: true of that file alone.
bool is_tally(std::string_view comment);

/// Numbers of vertices and faces that a file for viewers has no place for, in words, as "confidence
/// of vertices", one a kind: all but places, normals, colours, texture coordinates, and what
/// belongs to the map and to the numbers of the file.
std::vector<std::string> numbers_not_shown(const MeshFile& file);

}  // namespace sphparam
