#pragma once

#include <string>

#include "sphparam/measure/surface_distance.h"
#include "sphparam/errors.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::cli {

/// Throws UnmeasurableMesh for a mesh that has a map but no distances: without area, or of a size
/// whose powers doubles cannot hold. (Maps do not depend on size; fits and distances do.)
void require_measurable(const TriangleMesh& mesh);

/// How far a mesh made on a grid is from its source. Throws: UnmeasurableMesh where nothing of the
/// area is left on the grid; Cancelled.
SurfaceDistance distance_on_grid(const TriangleMesh& source, const TriangleMesh& made,
                                 const std::string& grid, const DistanceOptions& options);

}  // namespace sphparam::cli
