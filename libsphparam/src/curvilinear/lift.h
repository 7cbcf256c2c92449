#pragma once

#include "curvilinear/harmonic.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// x = cos θ sin ϕ, y = sin θ sin ϕ, z = cos ϕ at every vertex; the poles are reinserted at ±z.
/// Paper: Section 3. The lift of a fold-free chart may have folds: straight edges of the chart are
/// not the geodesics that the sphere map draws between the same ends.
SphereMap lift(const CutMesh& cut_mesh, const CurvilinearMap& map, int threads = 0);

}  // namespace sphparam
