#pragma once

#include "console/console.h"
#include "sphparam/io/mapped_mesh.h"
#include "commands/remesh_level.h"

namespace sphparam::cli {

/// Measures the fitted surface of a level and the flat faces on the same grid, both ways, and warns
/// where the flat ones are nearer. Requires: a fit.
void compare_with_flat(RemeshLevel& level, const TriangleMesh& flat, const MappedMesh& mapped,
                       Console& console);

}  // namespace sphparam::cli
