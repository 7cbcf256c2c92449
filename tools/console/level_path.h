#pragma once

#include <string>

namespace sphparam::cli {

/// The path of a level of detail's file: {n} becomes its number, else _lodN is added from the
/// second on, before ".ply" as before ".sph.ply"; level 0, the finest, has the path as it is.
std::string level_path(const std::string& path, int level);

}  // namespace sphparam::cli
