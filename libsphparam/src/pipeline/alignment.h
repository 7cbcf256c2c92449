#pragma once

#include "pipeline/map_in_progress.h"

namespace sphparam {

/// Turns the map to `work.options.align_to`, as one piece, and notes the angle that is left. It
/// stays as it is, with a warning, where turning folds it by rounding and untangling does not help.
/// Requires: a certified map, and directions to align to.
void align(MapInProgress& work);

/// Turns a map that was made anew to `work.orientation`, in the same way; where there is none it
/// stays. Requires: a certified map.
void keep_orientation(MapInProgress& work);

}  // namespace sphparam
