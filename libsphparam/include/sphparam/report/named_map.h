#pragma once

#include <string>

#include "sphparam/io/sphere_file.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// A map of a mesh made anywhere, and what a page calls it. It may fold, and its rays may have any
/// length: to see that is what pages are for.
struct NamedMap {
  std::string name;
  SphereMap map;               // one ray a vertex
  std::string source = {};     // authors and year, or the file's name; may be empty
  Provenance provenance = {};  // how it came about; may be empty
};

}  // namespace sphparam
