#pragma once

#include <optional>
#include <string>
#include <vector>

#include "arguments/remesh_arguments.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam::cli {

/// An image of `what` a vertex has: "position", "normal", "color" or a property.
struct ImageRequest {
  std::string what;
  std::string path;
};

/// What a command line of `remesh` asks for, having been found to make sense.
struct RemeshRequests {
  std::optional<GridSpec> grid;      // nothing: another sphere's vertices …
  std::string like;                  // … in this file
  std::vector<GridSpec> coarser;     // grids of --lods
  std::vector<std::string> outputs;  // of -o and --lods: one a level, or one .glb
  std::vector<ImageRequest> images;
  bool one_file = false;  // a .glb
};

/// Refuses before any work what makes no sense. Throws: UsageMistake; WriteError as `check_places`.
RemeshRequests check_remesh_arguments(const RemeshArguments& arguments);

}  // namespace sphparam::cli
