#pragma once

#include <vector>

#include "sphparam/mesh/surface_point.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// The nearest points of a sphere's flat triangles to directions, as points of the unit sphere:
/// where programs of neuroimaging look, while `SphereLocator` goes along the ray. `located`: what
/// that found, from where it is a few triangles at most; the vertices of a map stay themselves.
/// Requires: unit rays. Cost: some 1 µs a direction.
std::vector<SurfacePoint> nearest_on_facets(const Topology& topology, const SphereMap& map,
                                            const Points& directions,
                                            std::vector<SurfacePoint> located, int threads = 0);

}  // namespace sphparam
