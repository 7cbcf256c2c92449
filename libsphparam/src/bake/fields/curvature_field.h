#pragma once

#include <string>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"

namespace sphparam {

/// Curvature of the source, "mean" (also ""), (κ₁ + κ₂)/2 in 1/length, or "gauss", κ₁·κ₂ in
/// 1/length², positive where convex; averaged over 2 % of the radius of the sphere of the same
/// area, so that it does not depend on how finely the surface is meshed. The range is ± what 98 %
/// of the area stay within: grey is flat. Colours where the options ask for heat.
/// Throws: FieldError for other arguments.
SurfaceField curvature_field(const BakeScene& scene, const std::string& argument);

}  // namespace sphparam
