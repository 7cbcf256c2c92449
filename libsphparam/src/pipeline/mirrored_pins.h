#pragma once

#include <optional>
#include <string>
#include <vector>

#include "embedding/frame/landmarks.h"

namespace sphparam {

/// Words for pins that fit the mirror image of a map far better than the map: somebody counted
/// theta clockwise, or looked at the sphere from inside. Nothing where the pins leave it open:
/// fewer than three, or near a great circle, or far from both. `map`: of the mesh without the pins.
/// Cost: O(#pins). Source: our own.
std::optional<std::string> suspicion_of_mirror(const SphereMap& map, const std::vector<Pin>& pins);

}  // namespace sphparam
