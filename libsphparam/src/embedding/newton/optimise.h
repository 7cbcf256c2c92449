#pragma once

#include <vector>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/embedding/quality.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/progress.h"

namespace sphparam {

struct OptimiseOptions {
  DistortionEnergy energy = {};  // ε is not used: the map is valid at every moment
  double least_gain = 1e-5;  // 0 to 1; ends when a step lowers E by less than this share of what E
                             // has more than an isometry
  int max_steps = 100;       // ≥ 0
  double least_share = 0.5;  // 0 to 1; a system's iterations end with one that gains no more than
                             // this share of what all have: more steps against cheaper ones
  int sweeps = 4;            // ≥ 0: of guarded relaxation after every step
  std::vector<Vertex> pinned = {};  // may not move
  FillerMarks pressed = {};         // triangles that feel the energy's pressure; empty: none
  int threads = 0;                  // 0: all cores
  Progress progress = {};           // told after every step
};

struct OptimiseReport {
  int steps = 0;
  int linear_iterations = 0;  // summed over the steps
  double energy_before =
      0;  // both of the source as rounded to floats: to 1e-7, to less with slivers
  double energy_after = 0;
  bool converged = false;  // ended by `least_gain`, not by `max_steps`
};

struct Optimisation {
  SphereMap map;
  OptimiseReport report;
};

/// Minimises E over all vertices by projected Newton steps; the linear systems are solved by
/// conjugate gradients with algebraic multigrid, so that a step costs linear time and memory.
///
/// Ensures: E does not rise; every determinant stays certainly positive; pinned vertices keep their
/// bits; same bits for any number of threads. A map with a determinant that is not certain to be
/// positive comes back as it was, with energy_before = +∞, and one that covers the sphere more than
/// once comes back as it was.
/// Cost: about 0.7 µs a triangle and step on one thread; among slivers that block
/// steps up to five times as much. 350 bytes a triangle.
/// Paper: Teran et al., "Robust quasistatic finite elements" (2005), for the projection; its shape
/// space and the multigrid of rigid plates and dilations are our own.
Optimisation optimise(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                      const OptimiseOptions& options = {});

struct BalanceOptions {
  Balance balance = Balance::Lambda;
  // As energy.lambda from `least_lambda` to `greatest_lambda`: for which the map is about optimal.
  // Conformal: nearly conformal already, `least_lambda` as a rule.
  double from_lambda = 1;
  double area_error = 0.1;  // EqualArea: mean |log2 area ratio|, weighted by source area; ≥ 0
  OptimiseOptions optimise = {};  // at the λ aimed at; on the way there 1 % is good enough
};

struct BalancedMap {
  SphereMap map;
  double lambda;  // it is optimal for; `greatest_lambda` where areas were made even without energy
  double area_error;      // its mean |log2 area ratio|, weighted by source area
  OptimiseReport report;  // `energy_after` at that λ; steps of all
  RestTriangles aim;      // with areas corrected, what it is optimal for; empty: for the source
};

/// Minimises E for a λ far from 1, by continuation: from λ to λ in factors of ten or four, each
/// time from the map before. Straight from λ = 1 the steps would be many and short. Equal areas are
/// solid angles: where triangles are large, E's areas are corrected (see solid_angle_aim.h), and
/// energies are of these. Where they are missed the climb is made again, in factors of two, and
/// where that fails on up to 4,000 vertices, some of large triangles, comes `even_areas`. A
/// nearly conformal map is minimised at once, for the λ at which areas weigh 0.3 % of what its
/// angles miss, at most 0.1.
/// Requires: EnergyKind::AngleAndArea. Ensures: as `optimise`, but for E itself.
/// Throws: std::invalid_argument naming an option outside of its domain; Cancelled.
/// Cost: 3 to 5 steps a factor, of a second climb up to 60; then that of `even_areas`. Source: our
/// own.
BalancedMap optimise_balance(const Topology& topology, const RestTriangles& source,
                             const SphereMap& map, const BalanceOptions& options);

}  // namespace sphparam
