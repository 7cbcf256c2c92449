#pragma once

#include <string>
#include <vector>

#include "sphparam/mesh/mesh_repair.h"

namespace sphparam {

/// Whether loops are written under this name: .obj, or .ply, also in capitals.
bool is_loop_file(const std::string& path);

/// The loops as closed polylines: OBJ with a group a loop and its figures in a comment, or PLY with
/// edges, which name the loop they belong to. Coordinates have all their digits.
/// Requires: is_loop_file(path).
std::string serialise_loops(const std::string& path, const std::vector<HandleLoop>& loops);

}  // namespace sphparam
