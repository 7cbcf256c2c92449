#pragma once

#include "pipeline/map_in_progress.h"

namespace sphparam {

/// A vertex at the equator, on the half-circle that crosses fewest triangles.
Vertex quiet_meridian(const MapInProgress& work, const SphereMap& map);

/// Accepts the map with a vertex turned to θ = 0; false where that is not possible: a warning says
/// why.
bool turn(MapInProgress& work, const SphereMap& map, Vertex meridian);

}  // namespace sphparam
