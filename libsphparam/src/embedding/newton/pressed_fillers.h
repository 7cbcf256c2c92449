#pragma once

#include <optional>
#include <utility>

#include "embedding/newton/optimise.h"

namespace sphparam {

struct PressedMap {
  SphereMap map;
  double share;     // of the sphere that fillers take
  double pressure;  // that was needed, on the surface outwards or on fillers inwards: 0 or more
  /// E without the reward, by the areas that count where fillers are pressed; nothing: the map is
  /// as it was.
  std::optional<double> energy = std::nullopt;
};

/// Lowers the share of the sphere that fillers take to `most` or less, where it is more, and the
/// distortion of the rest: fillers count by no more than half of that share of the area, and there
/// is a reward on what the surface takes of the sphere, raised until it is enough.
///
/// `options`: as for `optimise`; their `pressed` are the fillers. `known`: the pressure that was
/// needed on a coarser level of the same map, or 0; then there is no search, and the map is settled
/// in any case. What cannot be pressed so far comes back as far as it came.
/// Ensures: as `optimise`. Cost: some ten Newton steps for each factor of four; with a known
/// pressure, as `optimise`. Our own: free boundaries go where the energy of the surface alone would
/// have them, and share is a limit, not a weight.
PressedMap press_fillers(const Topology& topology, RestTriangles source, const SphereMap& map,
                         double most, const OptimiseOptions& options, double known = 0);

/// What `press_fillers` does to the rest areas: fillers have no more than half of `most` of all,
/// the surface has the rest. Returns the factors of fillers and of the surface.
std::pair<double, double> pressed_areas(double of_fillers, double of_surface, double most);

}  // namespace sphparam
