#pragma once

#include <optional>
#include <vector>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

struct NewtonOptions {
  DistortionEnergy energy = {};  // ε > 0 allows folds, before and after
  int max_steps = 30;            // ≥ 0
  double least_gain = 1e-4;      // 0 to 1; ends when a step lowers E by less than this share
  std::optional<std::vector<Vertex>> vertices = {};  // that may move; all, if not given
  std::vector<Vertex> pinned = {};                   // that may not
  Progress progress = {};                            // told after every step
};

struct NewtonReport {
  int steps = 0;
  double energy_before = 0;  // of the triangles at vertices that may move
  double energy_after = 0;
  bool converged = false;  // ended by `least_gain`, not by `max_steps`
};

struct NewtonResult {
  SphereMap map;
  NewtonReport report;
};

/// Minimises E over some vertices by projected Newton steps, everything else fixed: direct
/// solvers instead of multigrid, so that tests have a second opinion on `optimise`.
///
/// Ensures: E does not rise; with ε = 0 every triangle with det > 0 keeps it, decided exactly, and
/// a map with a fold at a vertex that may move comes back as it was; fixed vertices keep their
/// bits. Throws: std::invalid_argument naming an option outside of its domain; Cancelled.
/// Cost: a sparse Cholesky factorisation of twice the number of free vertices a step (Eigen's
/// SimplicialLDLT: fine up to some 50,000 vertices).
/// Paper: Teran et al., "Robust quasistatic finite elements" (2005), for the projection; in the
/// 3×3 space of shapes, our own.
NewtonResult minimise_by_newton(const Topology& topology, const RestTriangles& source,
                                const SphereMap& map, const NewtonOptions& options = {});

}  // namespace sphparam
