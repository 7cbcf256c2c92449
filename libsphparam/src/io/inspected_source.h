#pragma once

#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// Whether somebody found out what a mesh is: `read_source`, a repair, or who filled the source.
bool is_inspected(const MeshSource& source);

/// A source that was filled with a file alone, with what `read_source` finds out of it but that no
/// vertices are welded: inspection and topology. Requires: it is not inspected.
MeshSource inspected(MeshSource source);

/// Whether a map can be made of it: a closed genus-0 mesh, and one with a shape.
bool is_mappable(const MeshSource& source);

/// What is to be mapped has a shape. Throws: UnmeasurableMesh where no face has area.
void require_area(const MeshSource& source);

}  // namespace sphparam
