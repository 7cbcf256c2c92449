#include "remesh/distance_on_grid.h"

namespace sphparam {

SurfaceDistance distance_on_grid(const TriangleMesh& source, const TriangleMesh& made,
                                 const std::string& grid, const DistanceOptions& options) try {
  return measure_distance(source, made, options);
} catch (const UnmeasurableSurface&) {
  throw UnmeasurableMesh("on " + grid + " nothing of this mesh's area is left: use a finer grid");
}

}  // namespace sphparam
