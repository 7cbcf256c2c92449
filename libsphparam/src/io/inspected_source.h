#pragma once

#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// Whether somebody found out what a mesh is: `read_source`, a repair, or who filled the source.
bool is_inspected(const MeshSource& source);

/// A source that was filled with a file alone, with what `read_source` finds out of it but that no
/// vertices are welded: inspection and topology. Requires: it is not inspected.
MeshSource inspected(MeshSource source);

}  // namespace sphparam
