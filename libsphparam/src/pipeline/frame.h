#pragma once

#include "pipeline/map_in_progress.h"

namespace sphparam {

/// Poles, pins and meridian of a finished map, as far as it takes them. Requires: it is certified,
/// and stays so.
void place_frame(MapInProgress& work);

}  // namespace sphparam
