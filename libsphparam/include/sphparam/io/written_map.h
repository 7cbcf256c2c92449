#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// A map of a mesh in a file of its own.
struct WrittenMap {
  MeshFile file;  // as it was read
  SphereMap map;  // its sx sy sz, else its vertices: a bare sphere about the origin. Of any length
  Provenance provenance;  // how it came about, if it says so
};

/// Throws: ReadError where the two are not one connectivity, which says what to give instead where
/// the file holds a surface of its own. `kind`: what the message calls such a file.
void require_connectivity_of(const MeshSource& mesh, const MeshSource& map,
                             const std::string& kind = "sphere");

/// Reads a map of a mesh. Nothing is proved of it. `kind`: what the message calls such a file.
/// Throws: ReadError, also where the two are not one connectivity.
WrittenMap read_map_of(const MeshSource& mesh, const std::string& path,
                       const ReadOptions& options = {}, const std::string& kind = "sphere");

}  // namespace sphparam
