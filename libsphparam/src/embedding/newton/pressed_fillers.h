#pragma once

#include "embedding/newton/optimise.h"

namespace sphparam {

struct PressedMap {
  SphereMap map;
  double share;     // of the sphere that fillers take
  double pressure;  // on the surface that was needed, outwards: 0 or more
};

/// Lowers the share of the sphere that fillers take to `most` or less, where it is more, and the
/// distortion of the rest: fillers count by no more than half of that share of the area, and there
/// is a reward on what the surface takes of the sphere, raised until it is enough.
///
/// `options`: as for `optimise`; their `pressed` are the fillers. What cannot be pressed so far
/// comes back as far as it came. Ensures: as `optimise`. Cost: some ten Newton steps for each
/// factor of four. Our own: free boundaries go where the energy of the surface alone would have
/// them, and share is a limit, not a weight.
PressedMap press_fillers(const Topology& topology, RestTriangles source, const SphereMap& map,
                         double most, const OptimiseOptions& options);

}  // namespace sphparam
