#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"

namespace sphparam::tools {

/// A map that cannot be made of a scene, or whose name nobody knows. Says what would help.
class MapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A kind of map that can be baked, for `--map`, its help and the manual.
struct MapKind {
  const char* name;   // "position"; "scalar:" takes an argument: scalar:NAME
  const char* about;  // one line, for --help
  /// `argument`: what follows the colon. Throws MapError where the scene has not what it needs.
  SurfaceField (*make)(const BakeScene& scene, const std::string& argument);
};

/// All kinds, in the order of --help. To add one: a function like `make` in fields/, a line in
/// map_kinds.cpp.
const std::vector<MapKind>& map_kinds();

/// The field of a name as the user wrote it: "ao", "id", "id:face", "scalar:thickness".
/// Throws: MapError.
SurfaceField make_field(const std::string& name, const BakeScene& scene);

}  // namespace sphparam::tools
