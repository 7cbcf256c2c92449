#pragma once

#include <vector>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

struct OptimiseOptions {
  DistortionEnergy energy = {};  // ε is not used: the map is valid at every moment
  double least_gain = 1e-5;      // ends when a step lowers E by less than this share
  int max_steps = 60;
  double linear_tolerance = 0.3;     // of the Newton systems: more steps against cheaper ones
  std::vector<Vertex> pinned = {};   // may not move
  int threads = 0;                   // 0: all cores
  Progress progress = {};            // told after every step
};

struct OptimiseReport {
  int steps = 0;
  int linear_iterations = 0;  // summed over the steps
  double energy_before = 0;
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
/// positive comes back as it was, with energy_before = +∞.
/// Cost: about 1 µs a triangle and step on one thread; 400 bytes a triangle.
/// Paper: Teran et al., "Robust quasistatic finite elements" (2005), for the projection; its shape
/// space and the multigrid of rigid plates and dilations are our own.
Optimisation optimise(const Topology& topology, const SourceTriangles& source, const SphereMap& map,
                      const OptimiseOptions& options = {});

}  // namespace sphparam
