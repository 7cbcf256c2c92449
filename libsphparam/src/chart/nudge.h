#pragma once

#include "chart/flat_mesh.h"

namespace sphparam {

/// Moves vertices in (u, v) by a few roundings of their coordinates, where that leaves fewer faces
/// around them folded: for triangles so small that rounding folds them. Vertices on the meridian
/// move along it. `folded` is what is folded, before and after. Returns how many vertices moved.
/// Cost: some µs a folded face; vertices of huge valence stay where they are.
int nudge(FlatMesh& flat, std::vector<Face>& folded);

}  // namespace sphparam
