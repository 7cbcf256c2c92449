#pragma once

#include "sphparam/chart/spherical_chart.h"
#include "sphparam/gltf/asset.h"
#include "sphparam/mesh/fillers.h"

namespace sphparam {

/// Marks of the faces of a chart, which belong to those of its source; empty: there are none.
FillerMarks fillers_of_chart(const SphericalChart& chart, const FillerMarks& of_source);

/// Takes marked triangles out of vertex buffers, and vertices that only they use.
/// Requires: a mark a triangle, or none at all.
void leave_out(Surface& surface, const FillerMarks& fillers);

}  // namespace sphparam
