#pragma once

#include <vector>

#include "pipeline/map_in_progress.h"
#include "sphparam/embedding/landmarks.h"

namespace sphparam {

/// Given poles, unless the map has them or they cannot be opposite, and the given pins.
/// Poles come first.
std::vector<Pin> wanted_pins(MapInProgress& work);

/// Embeds the mesh anew around the pins. The map so far says what they cost, and comes back where
/// that fails or poles alone are not reached.
/// Requires: pins, as `wanted_pins` gives them.
void hold(MapInProgress& work, const std::vector<Pin>& pins);

}  // namespace sphparam
