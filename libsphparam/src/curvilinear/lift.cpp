#include "curvilinear/lift.h"

#include "sphparam/parallel.h"
#include "sphparam/sphere/spherical_coordinates.h"

// Both wedges of a date line vertex lift to one point: cos and sin have period 2π.

namespace sphparam {

SphereMap lift(const CutMesh& cut_mesh, const CurvilinearMap& map, int threads) {
  constexpr std::int64_t grain = 4096;
  SphereMap sphere{Points(map.theta.size(), 3)};
  parallel_for(map.theta.size(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (Eigen::Index v = first; v < last; ++v) {
      sphere.points.row(v) = to_cartesian({map.theta[v], map.phi[v]});
    }
  });
  sphere.points.row(cut_mesh.poles().north) = Vector3(0, 0, 1);
  sphere.points.row(cut_mesh.poles().south) = Vector3(0, 0, -1);
  return sphere;
}

}  // namespace sphparam
