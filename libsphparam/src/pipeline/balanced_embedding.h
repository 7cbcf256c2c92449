#pragma once

#include <vector>

#include "pipeline/map_in_progress.h"
#include "sphparam/embedding/landmarks.h"

namespace sphparam {

/// The progressive embedding around the pins, then, where λ is far from 1 or to be found, its
/// balance of angles and areas. False, and nothing changes: it ran out of room.
bool embed(MapInProgress& work, const std::vector<Pin>& pins);

}  // namespace sphparam
