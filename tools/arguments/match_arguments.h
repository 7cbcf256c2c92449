#pragma once

#include <optional>
#include <string>

#include "arguments/repair_arguments.h"
#include "sphparam/correspondence/carried_shape.h"
#include "sphparam/correspondence/match.h"

namespace sphparam::cli {

/// The command line of `sphparam match`. Files that are empty are not wanted; spheres: the meshes'
/// own maps.
struct MatchArguments : CommonArguments {
  std::string first, second;
  std::string first_sphere, second_sphere;
  Words features;  // files or properties: of A, of B, of A …
  double feature_weight = 2;
  std::string landmarks, output, shape, values, back, morph, page;
  Placement placement = Placement::Scaled;  // of B in the morph
  Up up;                                    // of A there and on the page
  bool mirror = false;
  bool viewer = true;
  MatchOptions options;
  RepairArguments repair;  // of both
};

/// Looks at all names before any work. Throws: UsageMistake; WriteError.
void require_sensible(const MatchArguments& arguments);

void declare_options(Declaration& command, MatchArguments& arguments);

}  // namespace sphparam::cli
