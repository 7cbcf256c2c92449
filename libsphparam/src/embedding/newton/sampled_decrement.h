#pragma once

#include <vector>

#include "embedding/energy/image_point.h"
#include "embedding/energy/rest_floors.h"
#include "mesh/mesh_hierarchy.h"
#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// Estimates which share of a level's energy Newton steps would still take, 0 to 1, without making
/// one: by the Newton decrements of a few patches of some ten vertices, the rest of the map fixed.
/// It sees what sweeps leave where triangles are slivers, and not what whole protrusions lack.
///
/// `ring_energy`: of each vertex, about the energy of its triangles; patches lie where energy is.
/// 1 where numbers of a patch are beyond floats. Requires: every determinant certain to be
/// positive. Same bits for any number of threads. Cost: some 70 µs a patch, of which there are 12
/// to 64. Our own.
double sampled_decrement(const HierarchyLevel& level, const RestFloors& floors,
                         const std::vector<ImagePoint>& image,
                         const std::vector<float>& ring_energy, const DistortionEnergy& energy,
                         int threads);

}  // namespace sphparam
