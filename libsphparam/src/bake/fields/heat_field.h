#pragma once

#include <optional>

#include "bake/surface_field.h"
#include "render/heat.h"

namespace sphparam {

/// The same field as colours, for looking at: blue by white to red where its range is symmetric
/// about 0, else viridis. Keeps the range, as what the ends of the scale stand for.
/// Requires: a range, and one channel of data, with no origin.
SurfaceField as_heat(SurfaceField data);

/// The scale of a field that `as_heat` made, for `with_legend`; nothing for other fields.
std::optional<HeatScale> heat_scale_of(const SurfaceField& field);

}  // namespace sphparam
