#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

// Where copies of a vertex had several colours and became one vertex, each corner keeps its own:
// properties of faces, "corner_red_0" to "corner_alpha_2", as numbers of the type that "red" to
// "alpha" of the vertices have. Those stay, with the colour of one copy.

/// Red, green, blue, alpha of corners, 3·#F rows, as they are stored.
using CornerColours = RowTable<double, 4>;

/// Whether the property of faces is one of them.
bool is_corner_colour(const std::string& property);

/// Nothing where there are none; alpha is 0 where the vertices have none.
std::optional<CornerColours> corner_colours(const MeshFile& file);

/// For all channels that the vertices have. Requires: 3·#F rows.
void set_corner_colours(MeshFile& file, const CornerColours& colours);

void remove_corner_colours(MeshFile& file);

}  // namespace sphparam
