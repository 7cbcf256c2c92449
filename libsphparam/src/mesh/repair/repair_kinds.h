#pragma once

#include <string>
#include <vector>

#include "sphparam/mesh/mesh_repair.h"

namespace sphparam {

/// What else follows from a repair.
enum class RepairTrait {
  Nothing,
  CopiesVertices,    // several vertices may lie at one place after it
  MayFollowWelding,  // what it mends may have been made by the welding of what was read
  KeepsSurface,      // no point of the surface went
};

/// All that is known of a kind of repair.
struct RepairKindInfo {
  RepairKind kind;
  const char* name;               // "hole-filled"
  const char *one, *many, *done;  // "1 hole filled", "2 holes filled"; `done` alone without nouns
  RepairPlace place;              // what its ids name …
  const char* noun;               // … where they are told: "at vertices 1, 2"
  RepairTrait trait = RepairTrait::Nothing;
};

/// From the one table of all kinds.
const RepairKindInfo& info_of(RepairKind kind);

/// How often it was done.
long count_of(const std::vector<RepairAction>& actions, RepairKind kind);

}  // namespace sphparam
