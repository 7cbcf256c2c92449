#pragma once

#include <optional>
#include <vector>

#include "embedding/frame/axis_choice.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

struct PolePlacementOptions {
  DistortionEnergy energy = {};
  int sweeps = 10;       // ≥ 0: of pinned relaxation after every partial move
  int most_moves = 200;  // ≥ 1: partial moves before it gives up
  std::optional<Vertex> no_pole = std::nullopt;  // of an axis: this vertex becomes none
  int threads = 0;                               // 0: all cores
  Progress progress = {};
};

struct PolePlacement {
  SphereMap map;  // north at exactly (0, 0, 1), south at exactly (0, 0, −1)
  Vertex north = -1;
  Vertex south = -1;
  int moves = 0;  // partial moves it took
  double energy_before = 0;
  double energy_after = 0;  // the price of the poles: compare
};

/// Puts the axis of a finished map on z. Of the 32 vertices nearest to either end, the two that are
/// most nearly opposite become the poles: a rotation brings one to +z, and the other, a fraction of
/// an edge away from −z, goes there. All but the three rings around it is left
/// as it is, or all but twelve where three are not enough.
///
/// Ensures: no triangle folds but by rounding in the rotation: certify; same bits for any number of
///          threads. Returns nothing where none of the eight best pairs can be brought opposite, or
///          all share an edge: in meshes of a few vertices.
/// Requires: a bijective map; an axis that is not 0. Throws: std::invalid_argument naming an option
/// outside of its domain; Cancelled. Cost: two passes over the vertices, one over the triangles.
/// Our own; the energy around the south pole is what it costs: far below 1 % on real meshes, where
/// a limb hangs on it up to 2 %.
std::optional<PolePlacement> place_poles_on_axis(const Topology& topology,
                                                 const RestTriangles& source, const SphereMap& map,
                                                 const Vector3& axis,
                                                 const PolePlacementOptions& options = {});

/// Moves two given vertices of a bijective map to ±z and keeps it bijective.
///
/// A rotation brings north to +z. Seen in the plane by stereographic projection from there, a
/// translation brings south to the origin: a Möbius map that fixes north. Applied to vertices alone
/// it can fold wide triangles, so it is done in parts, each certified, with guarded relaxation in
/// between, both poles pinned. Sweeps alone converge slowly: ProgressiveOptions::pins gives better
/// maps; this is for maps made otherwise.
/// Requires: a bijective map; north and south share no edge (their geodesic would have no
/// direction). Returns nothing when a part cannot be made however small. Throws: as above, also
/// for what is no vertex. Our own.
std::optional<PolePlacement> place_poles(const Topology& topology, const RestTriangles& source,
                                         const SphereMap& map, Vertex north, Vertex south,
                                         const PolePlacementOptions& options = {});

/// The map turned about z until θ of the given vertex is exactly 0. Points at ±z stay there.
/// Requires: that vertex is not at ±z. Rounding may fold what is nearly flat: certify.
SphereMap turned_to_meridian(const SphereMap& map, Vertex meridian, int threads = 0);

/// The `count` vertices nearest to a direction (all, if there are fewer), the nearest first. Ties
/// go to the lower index. Cost: one pass.
std::vector<Vertex> nearest_vertices(const SphereMap& map, const Vector3& direction, int count,
                                     int threads = 0);

}  // namespace sphparam
