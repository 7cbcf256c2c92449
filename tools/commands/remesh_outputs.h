#pragma once

#include <optional>
#include <vector>

#include "arguments/remesh_arguments.h"
#include "console/session.h"
#include "sphparam/records/remesh_record.h"

namespace sphparam::cli {

/// What a remesh wrote.
struct RemeshFiles {
  std::optional<WrittenDisplacement> displacement;
  RemeshOutputs outputs;
};

/// Adds all files that are asked for to those of the session, where they wait; `levels` get their
/// texture coordinates, which follow from the displacement. `last_data`: the `last_attached` of
/// what was read. Requires: a level, the finest first. Throws: UsageMistake for what cannot be
/// written so; NotCertifiedError; ReadError; WriteError; Cancelled.
RemeshFiles add_files(const RemeshArguments& arguments, const RemeshRequests& requests,
                      const MappedMesh& mapped, int last_data, std::vector<LevelOfDetail>& levels,
                      Session& session);

}  // namespace sphparam::cli
