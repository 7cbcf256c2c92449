#include "correspondence/own_map.h"

#include <algorithm>

#include "embedding/frame/nearest_rotation.h"

namespace sphparam {
namespace {

constexpr double fitting = 1e-6;         // radians: landmarks of maps that mean the same
constexpr size_t telling_landmarks = 3;  // a rotation always nearly fits fewer

bool all_fit(const SphereMap& map, const std::vector<Pin>& pins) {
  return std::ranges::all_of(pin_residuals(map, pins),
                             [](double residual) { return residual <= fitting; });
}

}  // namespace

std::optional<SphereMap> fitting_map(const MappedMesh& from, const std::vector<Pin>& pins) {
  if (pins.empty() || all_exact(pin_residuals(from.map(), pins))) return from.map();
  if (pins.size() < telling_landmarks) return std::nullopt;
  SphereMap map = turned(from.map(), best_rotation(from.map(), pins));
  if (!all_fit(map, pins)) return std::nullopt;
  for (const Pin& pin : pins) map.points.row(pin.vertex) = pin.point;
  if (!certify(from.topology(), map).bijective()) return std::nullopt;
  return map;
}

}  // namespace sphparam
