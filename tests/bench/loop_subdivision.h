#pragma once

#include "sphparam/mesh/topology.h"

namespace sphparam::bench {

/// One step of Loop's subdivision (1987): four times the triangles, the shape smoothed. Benchmarks
/// use it to make large meshes of real ones.
TriangleMesh loop_subdivided(const TriangleMesh& mesh);

}  // namespace sphparam::bench
