#include "pipeline/alignment.h"

#include <cmath>

#include "embedding/constructions/gnomonic.h"
#include "embedding/constructions/untangle.h"
#include "embedding/frame/nearest_rotation.h"

// One rotation for all vertices, the nearest by area. Rounding it may fold triangles that are
// nearly flat; untangling opens these few again.

namespace sphparam {
namespace {

/// Rays of unit length; what is no direction takes no part: it weighs nothing.
SphereMap usable(const SphereMap& directions, VectorX& weights) {
  SphereMap result = directions;
  for (Vertex v = 0; v < result.points.rows(); ++v) {
    const double length = result.points.row(v).stableNorm();
    const bool is_ray = length > 0 && std::isfinite(length);
    if (!is_ray) weights[v] = 0;
    result.points.row(v) = is_ray ? Vector3(result.point(v) / length) : Vector3::UnitZ();
  }
  return result;
}

bool accept_turned(MapInProgress& work, const SphereMap& map) {
  if (work.accept_if_certified(map)) return true;
  const UntangleOptions untangling{.lambda = work.options.energy.lambda,
                                   .threads = work.options.threads,
                                   .progress = work.options.progress};
  return work.accept_if_certified(untangle(work.topology, work.source(), map, untangling).map);
}

/// The angle that is left.
double turn_to(MapInProgress& work, const SphereMap& directions) {
  VectorX areas = vertex_areas(work.topology, work.source());
  const SphereMap wanted = usable(directions, areas);
  if (areas.sum() == 0) return 0;
  if (work.result.map.points == wanted.points) return 0;
  const SphereMap map =
      turned(work.result.map, nearest_rotation(work.result.map.points, wanted.points, areas));
  if (!accept_turned(work, map)) {
    work.warn(
        "turning the map to the directions it should have folds it by rounding: it lies as "
        "it was made");
  }
  return rms_angle(work.result.map, wanted, areas);
}

}  // namespace

void align(MapInProgress& work) {
  report(work.options.progress, "alignment", 0);
  work.forget_poles();
  work.result.alignment = turn_to(work, *work.options.align_to);
  work.record("alignment", work.result.map);
}

void keep_orientation(MapInProgress& work) {
  if (work.orientation.points.rows() > 0) turn_to(work, work.orientation);
}

}  // namespace sphparam
