#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "sphparam/errors.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Samples of each side: enough for three digits, and no more than 16² on a face of the grid.
inline std::int64_t distance_samples(std::int64_t faces) {
  constexpr std::int64_t enough = 250'000, of_a_face = 16 * 16;
  return std::min<std::int64_t>(enough, of_a_face * faces);
}

/// How far a mesh made on a grid is from its source. Throws: UnmeasurableMesh where nothing of the
/// area is left on the grid; Cancelled.
SurfaceDistance distance_on_grid(const TriangleMesh& source, const TriangleMesh& made,
                                 const std::string& grid, const DistanceOptions& options);

}  // namespace sphparam
