#pragma once

#include <string>

#include "sphparam/io/mesh_source.h"
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

/// The map of a mesh that a file holds: its sx sy sz, or else the file is a sphere of the mesh, in
/// its order. `kind`: what the message calls such a file. Throws: ReadError, also where its
/// connectivity is another.
NamedMap load_named_map(const std::string& name, const std::string& path, const MeshSource& mesh,
                        const ReadOptions& options = {}, const std::string& kind = "map");

}  // namespace sphparam
