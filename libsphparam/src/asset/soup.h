#pragma once

#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// An asset without the vertices that have no place, and their triangles; `repairs` tells them.
MeshSource without_lost(const MeshSource& asset);

/// Its file without those and without the vertices that no triangle uses: by its box it is measured
/// how fine a wrap is.
MeshFile with_places(const MeshSource& asset);

}  // namespace sphparam
