#pragma once

#include "cli/mapped_source.h"
#include "cli/remesh_arguments.h"
#include "mesh_io/safe_file.h"

namespace sphparam::tools {

/// The new mesh as a .glb with the chart of its directions, as `export` writes it: with the
/// texture of the source where its coordinates are carried, else with the colours carried, else
/// with a checker. Quads are cut in two.
///
/// Throws: NotCertifiedError where (u, v) is not one-to-one; ReadError for positions beyond
/// float32; WriteError for more than a .glb holds, and as PendingFiles does; Cancelled.
void add_glb(PendingFiles& files, const RemeshArguments& arguments, const MappedSource& mapped,
             const Remeshed& result, const Provenance& provenance, Console& console);

}  // namespace sphparam::tools
