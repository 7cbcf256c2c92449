#pragma once

#include "mesh/handles/surface_cells.h"
#include "mesh/repair/rim_filling.h"

namespace sphparam {

/// Closes a rim with a cap: a membrane of well-shaped triangles, bent a little towards the side of
/// the surface that it closes, so that it is not where the cap of the other side is, and so that it
/// passes through as few faces as can be had. Returns how many pairs of its triangles and faces do
/// pass through one another. `own_side`: from the rim into that side. Cost: O(n), and the faces
/// beside it.
long close_by_cap(RepairState& state, const Rim& rim, const Vector3& own_side,
                  const SurfaceCells& surface);

}  // namespace sphparam
