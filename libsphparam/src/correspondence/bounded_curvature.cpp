#include "correspondence/bounded_curvature.h"

#include "sphparam/mesh/curvature.h"

namespace sphparam {
namespace {

constexpr double scale = 0.16;  // of curvature, in radii of the sphere of the same area
constexpr double sharp = 3;     // curvatures beyond these, in its units, are alike

}  // namespace

VectorX bounded_curvature(const MappedMesh& mapped, int threads) {
  const double radius = equal_area_radius(mapped.mesh(), threads);
  const Eigen::ArrayXd h =
      radius / sharp *
      measure_curvature(mapped.mesh(), mapped.topology(), scale * radius, threads).mean.array();
  return h / (1 + h.square()).sqrt();
}

}  // namespace sphparam
