#pragma once

#include <string>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"

namespace sphparam {

/// How high the source's surface stands: above the target's, along the target's normals (of unit
/// length, interpolated, those of its hard edges where it has such), negative below it; or, where
/// the options ask for it or the target is the source itself, its distance from the origin. In
/// units of the mesh. `argument` may be "radial" to ask for distances. Throws: FieldError for other
/// arguments.
SurfaceField height_field(const BakeScene& scene, const std::string& argument);

}  // namespace sphparam
