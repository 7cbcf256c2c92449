#pragma once

#include <vector>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

/// No number is below 0.
struct UntangleOptions {
  double lambda = 1;                // of E, see DistortionEnergy
  int rings = 2;                    // around the folds, doubled from round to round
  int max_rounds = 7;               // so at most 128 rings
  int max_patch = 20000;            // vertices; a larger patch loses its outer rings
  int max_steps = 60;               // Newton steps a patch and round
  double max_work = 3e5;            // Σ patch vertices × steps, after which no new round begins
  std::vector<Vertex> pinned = {};  // that may not move: poles
  int threads = 0;                  // 0: all cores; patches are solved side by side
  Progress progress = {};           // told after every round
};

struct UntangleReport {
  long folds_before = 0;  // triangles with det ≤ 0, decided exactly
  long folds_after = 0;
  int rounds = 0;
  long patches = 0;        // solved, summed over the rounds
  long steps = 0;          // Newton steps, summed over the patches
  double work = 0;         // Σ patch vertices × steps
  long largest_patch = 0;  // vertices
  long touched = 0;        // vertices that the last map has elsewhere than the first
  double seconds = 0;
};

struct Untangled {
  SphereMap map;
  UntangleReport report;
};

/// Repairs folds where they are.
///
/// Each round takes the vertices within some rings of the folds; every connected piece of them is
/// a patch whose rim is fixed. Newton steps on E with the divisor regularised unfold it, a few more
/// without regularisation make it clear of folding.
/// Ensures: never more folds than before; vertices outside the patches keep their bits; work is
/// bounded by the options; same bits for any number of threads. No guarantee that no fold is left.
/// Throws: std::invalid_argument naming an option outside of its domain; Cancelled.
/// Paper: Garanzha et al., "Foldover-free maps in 50 lines of code" (2021); patches on the sphere,
/// our own.
Untangled untangle(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                   const UntangleOptions& options = {});

}  // namespace sphparam
