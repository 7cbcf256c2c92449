#pragma once

#include <optional>
#include <string>
#include <utility>

#include "bake/bake_scene.h"
#include "bake/surface_field.h"
#include "render/heat.h"

namespace sphparam {

/// The same field as colours, for looking at: blue by white to red where its range is symmetric
/// about 0, else viridis. Keeps the range, as what the ends of the scale stand for, and has the
/// scale, which says where values lie beyond, if their `extent`, least and greatest, is told.
/// Requires: a range, and one channel of data, with no origin.
SurfaceField as_heat(SurfaceField data,
                     std::optional<std::pair<double, double>> extent = std::nullopt);

/// A property of vertices or faces, by its name: `make_scalar`; where heat is asked for in the
/// colours that `value_paint` has for it, those of labels never mixed. Throws: FieldError.
SurfaceField make_scalar_or_heat(const BakeScene& scene, const std::string& name);

}  // namespace sphparam
