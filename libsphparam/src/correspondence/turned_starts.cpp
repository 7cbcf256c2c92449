#include "correspondence/turned_starts.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// The excess of the best of those that lead elsewhere than the first.
std::optional<double> excess_elsewhere(const std::vector<Start>& starts) {
  for (const Start& other : starts)
    if (rms_angle(starts.front().places, other.places) > elsewhere) return other.excess;
  return std::nullopt;
}

Eigen::Matrix3d half_turn(int axis) {
  Vector3 diagonal = Vector3::Constant(-1);
  diagonal[axis] = 1;
  return diagonal.asDiagonal();
}

}  // namespace

double start_at_best(CoarseToFine& way, const SphereMap& map,
                     const std::vector<TurnOfFunctions>& turns, const ComposedEnergy& energy,
                     const std::function<void(const Eigen::Matrix3d&)>& prepare) {
  const double isometric = differentiate(energy.energy, 1, 1).f;
  const double least = std::isfinite(isometric) ? isometric : 0;
  std::vector<Start> starts;
  const auto add = [&](const Eigen::Matrix3d& rotation) {
    prepare(rotation);
    const double reached = way.start_at(turned(map, rotation));
    starts.push_back({rotation, reached - least, way.places()});
  };
  for (const TurnOfFunctions& turn : turns) add(turn.rotation);
  std::ranges::stable_sort(starts, {}, &Start::excess);
  // One start is better than others only if there are others.
  if (!excess_elsewhere(starts)) {
    const Eigen::Matrix3d only = starts.front().rotation;
    for (int axis = 0; axis < 3; ++axis) add(half_turn(axis) * only);
    std::ranges::stable_sort(starts, {}, &Start::excess);
  }
  const double best = starts.front().excess;
  prepare(starts.front().rotation);
  way.start_at(turned(map, starts.front().rotation));
  const std::optional<double> other = excess_elsewhere(starts);
  if (!other) return 1;
  return confidence_by_excess(best, *other);
}

bool leads_elsewhere(const SphereMap& one, const SphereMap& other) {
  const double rms = (one.points - other.points).norm() / std::sqrt(double(one.points.rows()));
  return rms > elsewhere;
}

double confidence_by_excess(double excess, double elsewhere) {
  return elsewhere > 0 ? std::clamp(1 - excess / elsewhere, 0.0, 1.0) : 0;
}

}  // namespace sphparam
