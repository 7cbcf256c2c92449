#include "embedding/newton/pressed_fillers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sphparam/sphere/sphere_share.h"

// All triangles together cover the sphere, and an energy of them all lets a boundary go where
// angles want it, which for a disk is half of the sphere. A reward on the area of the surface, −p S
// a triangle, draws it out over the holes: what it covers fillers lose. (A price on fillers is the
// same only while they are small: S is the volume below a triangle, and large ones hide from it.)
// From reward to reward the map before is a good start; the last interval is halved, so that the
// surface does not pay for more than was asked for. On meshes of a few large triangles the volume
// below them ends where they are alike, whatever the reward: what is missing there is pressed out
// of the fillers, which are small by then, by a price on theirs. The corners of an octahedron feel
// neither, as a determinant is greatest there: a nudge towards the middles of fillers comes first.

namespace sphparam {
namespace {

constexpr double rest_share = 0.5;  // of what fillers may take: their part of the rest areas
constexpr double raise = 4;
constexpr double least_reward = 0.01;  // of the first one that is tried
constexpr int most_raises = 10;        // a million times the energy of the surface
constexpr int most_halvings = 3;       // of the last interval, in logarithms
constexpr int most_retries = 4;        // where the last steps gave back more than the margin
constexpr double retry_raise = 1.5;
constexpr double near_enough = 0.8;  // of the share: not worth another try
constexpr double margin = 0.05;      // of it: what settles the map may give back
constexpr double on_the_way_gain = 3e-2;
constexpr int on_the_way_steps = 20;
constexpr double nudge = 0.05;    // of the way to a filler's middle; as much again each time
constexpr int small_mesh = 4000;  // vertices: where steps cost nothing, the search is thorough
constexpr double small_gain = 5e-3;
constexpr int small_steps = 60;

void shrink(RestTriangles& source, const FillerMarks& fillers, double most) {
  double of_surface = 0, of_fillers = 0;
  for (size_t f = 0; f < source.size(); ++f)
    (fillers[f] ? of_fillers : of_surface) += source[f].area;
  const auto [filler, surface] = pressed_areas(of_fillers, of_surface, most);
  for (size_t f = 0; f < source.size(); ++f) {
    source[f] = scaled(source[f], fillers[f] ? filler : surface);
  }
}

Triangles triangles_of(const Topology& topology) {
  Triangles triangles(topology.face_count(), 3);
  for (Face f = 0; f < topology.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) triangles(f, k) = topology.vertex(f, k);
  }
  return triangles;
}

class Press {
 public:
  Press(const Topology& topology, const RestTriangles& source, const OptimiseOptions& options)
      : topology_(topology),
        triangles_(triangles_of(topology)),
        source_(source),
        options_(options),
        fillers_(options.pressed) {
    for (unsigned char& mark : options_.pressed) mark = mark ? 0 : 1;
  }

  double share_of(const SphereMap& map) const { return sphere_share(triangles_, map, fillers_); }
  double energy_of(const SphereMap& map) const {
    return distortion_energy(topology_, source_, map, options_.energy, options_.threads);
  }

  /// The map for a reward, well enough to go on from.
  PressedMap roughly(const SphereMap& from, double pressure) const {
    OptimiseOptions options = options_;
    const bool small = topology_.vertex_count() <= small_mesh;
    options.least_gain = std::max(options.least_gain, small ? small_gain : on_the_way_gain);
    options.max_steps = std::min(options.max_steps, small ? small_steps : on_the_way_steps);
    return at(from, pressure, std::move(options));
  }
  PressedMap settled(const PressedMap& map) const { return at(map.map, map.pressure, options_); }

  /// With the corners of fillers nearer to their middles, by a part of the way; the same map where
  /// that has no room.
  SphereMap nudged(SphereMap map, double part) const {
    const SphereMap before = map;
    for (Face f = 0; f < topology_.face_count(); ++f) {
      if (!fillers_[static_cast<size_t>(f)]) continue;
      Vector3 middle = Vector3::Zero();
      for (int k = 0; k < 3; ++k) middle += before.point(topology_.vertex(f, k)) / 3;
      for (int k = 0; k < 3; ++k) {
        if (std::ranges::count(options_.pinned, topology_.vertex(f, k)) > 0) continue;
        auto point = map.points.row(topology_.vertex(f, k));
        point = (point + part * (middle.transpose() - point)).normalized();
      }
    }
    const double energy = distortion_energy(topology_, source_, map, options_.energy, 1);
    return std::isfinite(energy) ? map : before;
  }

  /// With a price on fillers instead of the reward.
  PressedMap priced(const SphereMap& from, double price) const {
    OptimiseOptions options = options_;
    options.pressed = fillers_;
    options.max_steps = std::min(options.max_steps, on_the_way_steps);
    return at(from, -price, std::move(options));
  }

 private:
  PressedMap at(const SphereMap& from, double pressure, OptimiseOptions options) const {
    options.energy.pressure = -pressure;
    SphereMap map = optimise(topology_, source_, from, options).map;
    const double share = share_of(map);
    return {std::move(map), share, std::abs(pressure)};
  }

  const Topology& topology_;
  const Triangles triangles_;
  const RestTriangles& source_;
  OptimiseOptions options_;  // which press the surface
  const FillerMarks fillers_;
};

/// The least reward, within a factor, that brings the share to `most`.
PressedMap rewarded(const Press& press, const SphereMap& map, double most, double first) {
  PressedMap below = press.roughly(map, 0);
  if (below.share <= most) return below;
  PressedMap above = press.roughly(below.map, first);
  for (int i = 0; i < most_raises && above.share > most; ++i) {
    below = std::move(above);
    above = press.roughly(below.map, raise * below.pressure);
  }
  double too_little = std::max(below.pressure, least_reward * first);
  for (int i = 0; i < most_halvings && above.share <= most; ++i) {
    if (above.share > near_enough * most) break;
    PressedMap middle = press.roughly(above.map, std::sqrt(too_little * above.pressure));
    if (middle.share > most) {
      too_little = middle.pressure;
    } else {
      above = std::move(middle);
    }
  }
  return above;
}

/// Where no reward was enough. The better of what came and what the least price brings that is.
PressedMap pressed_out(const Press& press, PressedMap map, double most, double first) {
  double price = first;
  for (int i = 0; i < most_raises && map.share > most; ++i, price *= raise) {
    PressedMap next = press.priced(press.nudged(map.map, (i + 1) * nudge), price);
    if (next.share < map.share) map = std::move(next);
  }
  return map;
}

}  // namespace

std::pair<double, double> pressed_areas(double of_fillers, double of_surface, double most) {
  if (!(of_surface > 0) || !(of_fillers > 0)) return {1, 1};
  const double all = of_fillers + of_surface;
  const double wanted = std::min(of_fillers, rest_share * most * all);
  return {wanted / of_fillers, (all - wanted) / of_surface};
}

PressedMap press_fillers(const Topology& topology, RestTriangles source, const SphereMap& map,
                         double most, const OptimiseOptions& options, double known) {
  const Press press(topology, source, options);
  const double before = press.share_of(map), first = std::max(options.energy.lambda, 1.0);
  if (before <= most && !(known > 0)) return {map, before, 0};
  shrink(source, options.pressed, most);
  PressedMap result = press.settled(known > 0 ? PressedMap{map, before, known}
                                              : rewarded(press, map, most * (1 - margin), first));
  for (int i = 0; i < most_retries && result.share > most; ++i) {
    result.pressure = std::max(result.pressure, 1.0) * retry_raise;
    result = press.settled(result);
  }
  result = pressed_out(press, std::move(result), most, first);
  result.energy = press.energy_of(result.map);
  return result;
}

}  // namespace sphparam
