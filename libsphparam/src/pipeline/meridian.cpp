#include "pipeline/meridian.h"

#include <numbers>

#include "embedding/frame/axis_choice.h"
#include "embedding/frame/pole_placement.h"
#include "sphparam/sphere/spherical_coordinates.h"

// Turning a map rounds it: it is certified again.

namespace sphparam {

Vertex quiet_meridian(const MapInProgress& work, const SphereMap& map) {
  const double theta = choose_meridian(work.topology, map, work.options.threads);
  const Vector3 front = to_cartesian({theta, std::numbers::pi / 2});
  return nearest_vertices(map, front, 1, work.options.threads).front();
}

bool turn(MapInProgress& work, const SphereMap& map, Vertex meridian) {
  const Vector3 x = map.point(meridian);
  if (!work.options.pins.empty()) {
    work.warn("pins fix every direction: no other meridian");
  } else if (x.x() == 0 && x.y() == 0) {
    work.warn("a pole has no longitude: it cannot be the meridian");
  } else if (!work.accept_if_certified(turned_to_meridian(map, meridian, work.options.threads))) {
    work.warn("turning the map to its meridian folds it by rounding");
  } else {
    work.result.meridian = meridian;
    return true;
  }
  return false;
}

}  // namespace sphparam
