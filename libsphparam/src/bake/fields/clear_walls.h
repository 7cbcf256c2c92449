#pragma once

#include "bake/surface_field.h"

namespace sphparam {

/// A base colour whose alpha masks out what walls hide (see CalmWalls), so that ways through a wrap
/// can be looked through, from both sides of what is left: its metadata say so. A field that is of
/// samples alone stays as it is.
SurfaceField with_clear_walls(SurfaceField colour);

}  // namespace sphparam
