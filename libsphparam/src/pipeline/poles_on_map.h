#pragma once

#include "pipeline/map_in_progress.h"

namespace sphparam {

/// Moves two vertices of a certified map to ±z, if that is possible without folds.
void move_to_poles(MapInProgress& work, Poles poles);

/// Poles, where they cost least, and a meridian for a certified map that is free to turn.
void choose_poles_on_map(MapInProgress& work);

}  // namespace sphparam
