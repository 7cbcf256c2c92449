#pragma once

#include <string>

#include "sphparam/errors.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// How far a mesh made on a grid is from its source. Throws: UnmeasurableMesh where nothing of the
/// area is left on the grid; Cancelled.
SurfaceDistance distance_on_grid(const TriangleMesh& source, const TriangleMesh& made,
                                 const std::string& grid, const DistanceOptions& options);

}  // namespace sphparam
