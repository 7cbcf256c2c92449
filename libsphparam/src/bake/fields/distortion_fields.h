#pragma once

#include <string>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"

namespace sphparam {

/// How the map distorts, one number a triangle of the source, log₂ of a ratio: see `heat_values`.
/// Where a triangle collapsed on either side, ±32. Colours on the fixed scales of `heat_scale`
/// where the options ask for heat. `argument` is not looked at.
SurfaceField area_field(const BakeScene& scene, const std::string& argument);
SurfaceField angle_field(const BakeScene& scene, const std::string& argument);
SurfaceField stretch_field(const BakeScene& scene, const std::string& argument);

}  // namespace sphparam
