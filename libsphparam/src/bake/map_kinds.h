#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"

namespace sphparam {

/// A map that cannot be made of a scene, or whose name nobody knows. Says what would help.
class MapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// `unknown` is the name that is not among `known`: whoever talks to the user may suggest one.
  MapError(const std::string& message, std::string unknown, std::vector<std::string> known)
      : std::runtime_error(message), unknown_(std::move(unknown)), known_(std::move(known)) {}

  const std::string& unknown() const { return unknown_; }  // empty: it is no matter of names
  const std::vector<std::string>& known() const { return known_; }

 private:
  std::string unknown_;
  std::vector<std::string> known_;
};

/// A kind of map that can be baked, for `--map`, its help and the manual.
struct MapKind {
  const char* name;   // "position"; "scalar:" takes an argument: scalar:NAME
  const char* about;  // one line, for --help
  /// `argument`: what follows the colon; empty where none is taken. Throws MapError where the scene
  /// has not what it needs.
  SurfaceField (*make)(const BakeScene& scene, const std::string& argument);
  bool takes_argument = false;
};

/// All kinds, in the order of --help. To add one: a function like `make` in fields/, a line in
/// map_kinds.cpp.
const std::vector<MapKind>& map_kinds();

/// Throws: MapError for a name with a colon whose kind takes no argument.
void require_no_idle_argument(const std::string& name);

/// The field of a name as the user wrote it: "ao", "id", "id:face", "scalar:thickness".
/// Throws: MapError.
SurfaceField make_field(const std::string& name, const BakeScene& scene);

}  // namespace sphparam
