#pragma once

#include "sphparam/errors.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Throws UnmeasurableMesh for a mesh that has a map but no distances: without area, or of a size
/// whose powers doubles cannot hold. (Maps do not depend on size; fits and distances do.)
void require_measurable(const TriangleMesh& mesh);

/// Of the box about points: what distances are told against. Requires: a point.
double diagonal_of(const Points& points);

}  // namespace sphparam
