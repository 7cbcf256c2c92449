#pragma once

#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// The file of an asset without the vertices that have no place, and their triangles.
MeshFile with_places(const MeshSource& asset);

}  // namespace sphparam
