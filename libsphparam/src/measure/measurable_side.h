#pragma once

#include "sphparam/measure/surface_distance.h"

namespace sphparam {

/// Throws: UnmeasurableSurface where there is no triangle, one names a vertex that is not there, or
/// a coordinate is not finite.
void require_measurable(const TriangleMesh& mesh, Side side);

}  // namespace sphparam
