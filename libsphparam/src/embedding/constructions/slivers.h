#pragma once

#include "embedding/energy/rest_floors.h"
#include "embedding/newton/optimise.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// Leads a map of triangles fattened by `fattening` to those that there are, slimmer by a factor of
/// three from step to step. A few Newton steps each do, since no sliver is next to being folded on
/// the way; straight from the map they would be hundreds, each stopped by another sliver. What is
/// left at the end is for steps by the slim ones.
/// `how`: as for `optimise`; its `least_gain` and `max_steps` are of each step of the way.
/// Ensures: every determinant stays certainly positive; same bits for any number of threads. Cost:
/// some 15 to 100 Newton steps. Our own.
SphereMap slim_down(const Topology& topology, const RestTriangles& source, SphereMap map,
                    const OptimiseOptions& how);

}  // namespace sphparam
