#pragma once

#include <optional>
#include <utility>

#include "sphparam/baselines/baseline_result.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"

namespace sphparam {

struct BrechbuehlerOptions {
  /// North and south; without: the vertices of greatest and least z, as the authors take them.
  std::optional<std::pair<Vertex, Vertex>> poles = std::nullopt;
  int max_steps = 50;  // ≥ 0, of the optimisation; 0: the initial map
  /// 0 to 1; a step that lowers the merit by a smaller share is the last of its ρ.
  double least_gain = 1e-4;
  double greatest_penalty = 1000;  // ρ at the end, at least 1; it starts at 1
  int threads = 0;                 // 0: all cores
};

/// Latitude and longitude by heat conduction, then equal areas with least distortion: Brechbühler,
/// Gerig, Kübler, "Parametrization of closed surfaces for 3-D shape description" (1995), the
/// paper's reference [2].
///
/// Latitude is harmonic with 0 and π at the poles, longitude harmonic with period 2π across a date
/// line that follows the steepest latitude; all conductances are equal. Then Σ cos(side) over all
/// edges is maximised (Cartesian, so that the poles are points like others), under the constraints
/// that every face has its share of the surface's area and no angle is negative.
/// Theirs are the squares of voxels, as many as vertices; triangles are twice as many, so that
/// their areas alone determine the map and can in general not all be met without a fold. Hence, in
/// place of their multipliers, ours: a growing penalty ρ/2 Σ (Ω − A)²/A, minimised by Gauss–Newton
/// steps with Levenberg–Marquardt damping in the size of each star. Active sets as theirs: a step
/// that would turn an angle negative is refused, and the triangle's area held until ρ grows.
///
/// Ensures: the number of folds does not rise after the initial map; same bits for any number of
/// threads. Requires: closed genus-0 mesh. Throws: Cancelled.
/// Cost: two factorisations of #V unknowns, and one of 2·#V a step.
BaselineResult map_brechbuehler(const TriangleMesh& mesh, const Topology& topology,
                                const BrechbuehlerOptions& options = {},
                                const Progress& progress = {});

/// The initial map in the authors' coordinates.
struct LatitudeLongitude {
  VectorX latitude;               // #V: 0 at the north pole to π at the south pole
  VectorX longitude;              // #V: any real numbers; of the poles 0
  std::vector<Vertex> date_line;  // from pole to pole
};

/// Latitude and longitude as two stationary temperatures: one between the poles, one around them
/// from the date line. Nothing when the poles are the same or adjacent, or where latitude is flat
/// in double precision. Throws: std::invalid_argument for a pole that is no vertex; SolveError.
std::optional<LatitudeLongitude> conduct_heat(const Topology& topology, Vertex north, Vertex south,
                                              int threads = 0);

}  // namespace sphparam
