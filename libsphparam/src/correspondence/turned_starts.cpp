#include "correspondence/turned_starts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "embedding/frame/nearest_rotation.h"

namespace sphparam {
namespace {

constexpr double elsewhere = 0.2;  // radians between starts that lead to different maps

struct Start {
  Eigen::Matrix3d rotation;
  double excess;  // of energy, beyond isometry
  std::vector<Place> places;
};

double rms_angle(const std::vector<Place>& a, const std::vector<Place>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i].direction - b[i].direction).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

double start_at_best(CoarseToFine& way, const SphereMap& map,
                     const std::vector<TurnOfFunctions>& turns, const ComposedEnergy& energy) {
  const double isometric = differentiate(energy.energy, 1, 1).f;
  const double least = std::isfinite(isometric) ? isometric : 0;
  std::vector<Start> starts;
  for (const TurnOfFunctions& turn : turns) {
    const double reached = way.start_at(turned(map, turn.rotation));
    starts.push_back({turn.rotation, reached - least, way.places()});
  }
  std::ranges::stable_sort(starts, {}, &Start::excess);
  const Start& best = starts.front();
  way.start_at(turned(map, best.rotation));
  for (const Start& other : starts)
    if (rms_angle(best.places, other.places) > elsewhere)
      return other.excess > 0 ? std::clamp(1 - best.excess / other.excess, 0.0, 1.0) : 0;
  return 1;
}

}  // namespace sphparam
