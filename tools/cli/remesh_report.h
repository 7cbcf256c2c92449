#pragma once

#include <string>

#include "cli/mapped_source.h"
#include "cli/remesh_arguments.h"
#include "remesh/remesh.h"

namespace sphparam::tools {

/// What `remesh --json` tells. The keys never change their meaning.
struct RemeshReport {
  const RemeshArguments& arguments;
  const MappedSource& source;
  const Remeshed& result;
  double grid_seconds = 0, seconds = 0;
};
std::string to_json(const RemeshReport& report);

}  // namespace sphparam::tools
