#pragma once

#include <string>
#include <vector>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"

namespace sphparam {

/// Makes fields of one kind.
struct FieldMaker {
  const char* name;   // "position"; "scalar" takes an argument: scalar:NAME
  const char* about;  // one line, for lists
  /// `argument`: what follows the colon; empty where none is taken. Throws FieldError where the
  /// scene has not what it needs.
  SurfaceField (*make)(const BakeScene& scene, const std::string& argument);
  bool takes_argument = false;
};

/// All kinds, in the order of lists. To add a field that is baked: a file in fields/ with a
/// function like `make`, and a line in field_registry.cpp; engine, command line, help and manual
/// follow.
const std::vector<FieldMaker>& field_makers();

/// The field of a name as the user wrote it: "ao", "id", "id:face", "scalar:thickness".
/// Throws: FieldError.
SurfaceField make_field(const std::string& name, const BakeScene& scene);

}  // namespace sphparam
