#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "arguments/remesh_arguments.h"
#include "commands/remesh_displacement.h"
#include "commands/remesh_lods.h"
#include "remesh/remesh.h"
#include "remesh/sample_density.h"
#include "remesh/subdivision_fit.h"

namespace sphparam::cli {

/// What `remesh --json` tells. The keys never change their meaning.
struct RemeshReport {
  const RemeshArguments& arguments;
  const MappedMesh& source;
  const Remeshed& result;
  std::optional<Adaptation> adaptation;  // with --adaptive
  const std::optional<SubdivisionFit>& fit;
  const std::optional<DisplacementReport>& displacement;
  const std::vector<RemeshLevel>& levels;  // told where there are several
  double grid_seconds = 0, seconds = 0;
};
std::string to_json(const RemeshReport& report);

}  // namespace sphparam::cli
