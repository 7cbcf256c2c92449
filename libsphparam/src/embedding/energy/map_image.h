#pragma once

#include <vector>

#include "embedding/energy/image_point.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// The points of a map as the sweeps and steps take them, and back. Cost: one pass.
std::vector<ImagePoint> image_of(const SphereMap& map);
SphereMap map_of(const std::vector<ImagePoint>& image);

}  // namespace sphparam
