#pragma once

#include "cli/console.h"
#include "cli/mapped_source.h"
#include "cli/remesh_level.h"

namespace sphparam::tools {

/// Measures the fitted surface of a level and the flat faces on the same grid, both ways, and warns
/// where the flat ones are nearer. Requires: a fit.
void compare_with_flat(RemeshLevel& level, const TriangleMesh& flat, const MappedSource& mapped,
                       Console& console);

}  // namespace sphparam::tools
