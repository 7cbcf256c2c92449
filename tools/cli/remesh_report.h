#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/mapped_source.h"
#include "cli/remesh_arguments.h"
#include "cli/remesh_displacement.h"
#include "cli/remesh_lods.h"
#include "remesh/remesh.h"
#include "remesh/sample_density.h"
#include "remesh/subdivision_fit.h"

namespace sphparam::tools {

/// What `remesh --json` tells. The keys never change their meaning.
struct RemeshReport {
  const RemeshArguments& arguments;
  const MappedSource& source;
  const Remeshed& result;
  std::optional<Adaptation> adaptation;  // with --adaptive
  const std::optional<SubdivisionFit>& fit;
  const std::optional<DisplacementReport>& displacement;
  const std::vector<RemeshLevel>& levels;  // told where there are several
  double grid_seconds = 0, seconds = 0;
};
std::string to_json(const RemeshReport& report);

}  // namespace sphparam::tools
