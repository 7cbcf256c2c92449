#pragma once

#include <optional>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

struct PolePlacementOptions {
  DistortionEnergy energy = {};
  int sweeps = 10;       // of pinned relaxation after every partial move
  int most_moves = 200;  // partial moves before it gives up
  int threads = 0;       // 0: all cores
  Progress progress = {};
};

struct PolePlacement {
  SphereMap map;  // north at exactly (0, 0, 1), south at exactly (0, 0, −1)
  int moves = 0;  // partial moves it took
  double energy_before = 0;
  double energy_after = 0;  // the price of the poles: compare
};

/// Moves two vertices of a bijective map to ±z and keeps it bijective.
///
/// A rotation brings north to +z. Seen in the plane by stereographic projection from there, a
/// translation brings south to the origin: a Möbius map that fixes north. Applied to vertices alone
/// it can fold wide triangles, so it is done in parts, each certified, with guarded relaxation in
/// between, both poles pinned.
/// Requires: a bijective map; north and south share no edge (their geodesic would have no
/// direction). Returns nothing when a part cannot be made however small. Our own.
std::optional<PolePlacement> place_poles(const Topology& topology, const SourceTriangles& source,
                                         const SphereMap& map, Vertex north, Vertex south,
                                         const PolePlacementOptions& options = {});

}  // namespace sphparam
