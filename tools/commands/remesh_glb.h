#pragma once

#include <span>

#include "arguments/remesh_arguments.h"
#include "console/session.h"
#include "sphparam/remesh/levels_of_detail.h"

namespace sphparam::cli {

/// The new mesh as a .glb with the chart of its directions, as `export` writes it: with the
/// texture of the source where its coordinates are carried, else with the colours carried, else
/// with a checker. Quads are cut in two. Coarser levels hang on the finest by MSFT_lod, which is
/// what viewers without it show; the extras tell the error of each.
///
/// Requires: a level, the finest first. Throws: NotCertifiedError where (u, v) is not one-to-one;
/// ReadError for positions beyond float32; WriteError for more than a .glb holds, and as
/// PendingFiles does; Cancelled.
void add_glb(const RemeshArguments& arguments, const MappedMesh& mapped,
             std::span<const LevelOfDetail> levels, Session& session);

}  // namespace sphparam::cli
