#include "sphparam/correspondence/map_alignment.h"

#include <algorithm>
#include <numbers>

#include "correspondence/bounded_curvature.h"
#include "elementary.h"
#include "embedding/frame/nearest_rotation.h"
#include "mesh/triangle_geometry.h"
#include "sphere/solid_angle.h"
#include "sphparam/mesh/curvature.h"
#include "sphparam/version.h"

namespace sphparam {
namespace {

constexpr double most_ln_area = 3;

/// ln of the share of the sphere over the share of the area, per vertex.
VectorX ln_area_ratio(const MappedMesh& mapped, int threads) {
  const VectorX sphere =
      vertex_solid_angles(mapped.topology(), mapped.map()) / (4 * std::numbers::pi);
  const VectorX area = measure_curvature(mapped.mesh(), mapped.topology(), 0, threads).area;
  const double whole = area.sum();
  VectorX result(area.size());
  for (Eigen::Index v = 0; v < area.size(); ++v)
    result[v] =
        std::clamp(elementary::log(sphere[v] / (area[v] / whole)), -most_ln_area, most_ln_area);
  return result;
}

}  // namespace

Functions map_signals(const MappedMesh& mapped, const MapSignalOptions& options) {
  Functions values(mapped.mesh().vertex_count(), 2);
  values << bounded_curvature(mapped, options.threads), ln_area_ratio(mapped, options.threads);
  return map_signals(mapped, values, options);
}

Functions map_signals(const MappedMesh& mapped, const Functions& values,
                      const MapSignalOptions& options) {
  return fit_harmonics(
             mapped.topology(), mapped.map(), values,
             {.degree = options.degree, .least_squares = false, .threads = options.threads})
      .coefficients;
}

std::vector<TurnOfFunctions> align_maps(const MappedMesh& from, const MappedMesh& to, int most,
                                        const MapSignalOptions& options) {
  return turns_by_correlation(map_signals(from, options), map_signals(to, options), most,
                              options.threads);
}

MappedMesh turned_map(const MappedMesh& mapped, const Eigen::Matrix3d& rotation) {
  return mapped.with_map(
      turned(mapped.map(), rotation),
      {{"version", version}, {"method", "align"}, {"stage", "turned"}, {"verdict", "one-to-one"}});
}

}  // namespace sphparam
