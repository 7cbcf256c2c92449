#pragma once

#include <optional>

#include "sphparam/embedding/axis_choice.h"
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
  Vertex north = -1;
  Vertex south = -1;
  int moves = 0;  // partial moves it took
  double energy_before = 0;
  double energy_after = 0;  // the price of the poles: compare
};

/// Puts the axis of a finished map on z: a rotation brings the vertex nearest to it to +z, then the
/// vertex nearest to −z goes there, all but the three rings around it left as they are.
///
/// Ensures: no triangle that was not folded by the rotation's rounding folds; same bits for any
///          number of threads. Returns nothing where that vertex cannot reach −z, or where it is
///          the north pole or its neighbour: in meshes of a few vertices.
/// Requires: a bijective map. Cost: two passes over the vertices and one over the triangles.
/// Our own; it costs at most 0.01 % of the energy on real meshes.
std::optional<PolePlacement> place_poles_on_axis(const Topology& topology,
                                                 const SourceTriangles& source,
                                                 const SphereMap& map, const Vector3& axis,
                                                 const PolePlacementOptions& options = {});

/// Moves two given vertices of a bijective map to ±z and keeps it bijective.
///
/// A rotation brings north to +z. Seen in the plane by stereographic projection from there, a
/// translation brings south to the origin: a Möbius map that fixes north. Applied to vertices alone
/// it can fold wide triangles, so it is done in parts, each certified, with guarded relaxation in
/// between, both poles pinned. Sweeps alone converge slowly: ProgressiveOptions::pins gives better
/// maps; this is for maps made otherwise.
/// Requires: a bijective map; north and south share no edge (their geodesic would have no
/// direction). Returns nothing when a part cannot be made however small. Our own.
std::optional<PolePlacement> place_poles(const Topology& topology, const SourceTriangles& source,
                                         const SphereMap& map, Vertex north, Vertex south,
                                         const PolePlacementOptions& options = {});

/// The map turned about z until θ of the given vertex is exactly 0. Points at ±z keep their bits.
/// Requires: that vertex is not at ±z. Rounding may fold what is nearly flat: certify.
SphereMap turned_to_meridian(const SphereMap& map, Vertex meridian, int threads = 0);

/// The vertex nearest to a direction. Ties go to the lower index. Cost: one pass.
Vertex nearest_vertex(const SphereMap& map, const Vector3& direction, int threads = 0);

}  // namespace sphparam
