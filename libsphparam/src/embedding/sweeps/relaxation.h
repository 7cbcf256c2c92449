#pragma once

#include <optional>
#include <vector>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

struct RelaxationOptions {
  DistortionEnergy energy = {};                      // ε is not used: relaxation needs the barrier
  int sweeps = 10;                                   // ≥ 0; each visits every vertex once
  double over_relaxation = 1.6;                      // first step tried, in Newton steps; see below
  std::optional<std::vector<Vertex>> vertices = {};  // that may move; all, if not given
  std::vector<Vertex> pinned = {};                   // that may not: poles
  int threads = 0;                                   // 0: all cores
  Progress progress = {};                            // told after every sweep
  bool measure_energy = true;  // before and after: two passes over all triangles
};

/// From 0, nothing moves, to here; halved until a step is downhill.
constexpr double most_over_relaxation = 10;

struct RelaxationReport {
  int sweeps = 0;
  long steps = 0;            // vertices moved, summed over the sweeps
  long refused = 0;          // steps wanted that no step length made safe and downhill
  long skipped = 0;          // visits of vertices whose ring is folded or not certain
  double energy_before = 0;  // +∞ on a folded map, up to rounding; 0 if not measured
  double energy_after = 0;
};

struct Relaxation {
  SphereMap map;
  RelaxationReport report;
};

/// Lowers E by vertex-local Newton steps, in the manner of Gauss and Seidel.
///
/// A vertex moves only if the orientation of every triangle of its ring is certain to be positive
/// afterwards and the ring's energy falls. A vertex whose ring has a fold stays where it is.
/// Ensures: E does not rise; every triangle with det > 0 keeps it, exactly; vertices that may not
/// move keep their bits; same bits for any number of threads.
/// Requires: unit points up to rounding. Throws: std::invalid_argument naming an option outside of
/// its domain; Cancelled. Cost: O(Σ valence) a sweep, about 0.1 µs a triangle.
/// Our own, after the local steps of Praun and Hoppe, "Spherical parametrization and remeshing"
/// (2003): colours of independent vertices instead of a sequence, Newton instead of a line search.
Relaxation relax(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                 const RelaxationOptions& options = {});

}  // namespace sphparam
