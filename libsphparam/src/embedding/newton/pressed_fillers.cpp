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
// surface does not pay for more than was asked for.

namespace sphparam {
namespace {

constexpr double rest_share = 0.5;  // of what fillers may take: their part of the source's area
constexpr double raise = 4;
constexpr int most_raises = 10;   // a million times the energy of the surface
constexpr int most_halvings = 3;  // of the last interval, in logarithms
constexpr int most_retries = 4;   // where the last steps gave back more than the margin
constexpr double retry_raise = 1.5;
constexpr double near_enough = 0.8;  // of the share: not worth another try
constexpr double margin = 0.05;      // of it: what settles the map may give back
constexpr double on_the_way_gain = 3e-2;
constexpr int on_the_way_steps = 20;

/// Fillers shrunk to `share` of all, if they have more; the total stays.
void shrink(RestTriangles& source, const FillerMarks& fillers, double share) {
  double all = 0, of_fillers = 0;
  for (size_t f = 0; f < source.size(); ++f) {
    all += source[f].area;
    if (fillers[f]) of_fillers += source[f].area;
  }
  const double surface = all - of_fillers, wanted = std::min(of_fillers, share * all);
  if (!(surface > 0) || !(of_fillers > 0)) return;
  for (size_t f = 0; f < source.size(); ++f) {
    source[f] = scaled(source[f], fillers[f] ? wanted / of_fillers : (all - wanted) / surface);
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

  /// The map for a reward, well enough to go on from.
  PressedMap roughly(const SphereMap& from, double pressure) const {
    OptimiseOptions options = options_;
    options.least_gain = std::max(options.least_gain, on_the_way_gain);
    options.max_steps = std::min(options.max_steps, on_the_way_steps);
    return at(from, pressure, std::move(options));
  }
  PressedMap settled(const PressedMap& map) const { return at(map.map, map.pressure, options_); }

 private:
  PressedMap at(const SphereMap& from, double pressure, OptimiseOptions options) const {
    options.energy.pressure = -pressure;
    SphereMap map = optimise(topology_, source_, from, options).map;
    const double share = share_of(map);
    return {std::move(map), share, pressure};
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
  double too_little = below.pressure;
  for (int i = 0; i < most_halvings && too_little > 0 && above.share <= most; ++i) {
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

}  // namespace

PressedMap press_fillers(const Topology& topology, RestTriangles source, const SphereMap& map,
                         double most, const OptimiseOptions& options) {
  const Press press(topology, source, options);
  const double before = press.share_of(map);
  if (before <= most) return {map, before, 0};
  shrink(source, options.pressed, rest_share * most);
  PressedMap result = press.settled(
      rewarded(press, map, most * (1 - margin), std::max(options.energy.lambda, 1.0)));
  for (int i = 0; i < most_retries && result.share > most; ++i) {
    result.pressure = std::max(result.pressure, 1.0) * retry_raise;
    result = press.settled(result);
  }
  return result;
}

}  // namespace sphparam
