#pragma once

#include <vector>

#include "curvilinear/harmonic.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

struct CurvilinearOptions {
  int iterations = 2;  // ≥ 0: quasi-harmonic iterations, at most; each costs a factorisation
  double epsilon = 0;  // 0 to 1.5 radians from poles to rims; 0: each cap gets its star's area
  int threads = 0;     // 0: all cores
};

/// A chart that is one-to-one, and its lift, which need not be.
struct CurvilinearResult {
  SphereMap map;
  DateLine date_line;
  long planar_folds = 0;                // of the chart that was lifted; 0 but for rounding
  int iterations = 0;                   // quasi-harmonic iterations that were kept
  std::vector<double> area_distortion;  // mean |ln κ| of the initial map and after each of them
  long clamped_weights = 0;             // corner terms of degenerate triangles, see EdgeWeights
};

/// The paper made sound: θ periodic with a free date line, symmetrised mean value weights, κ
/// accumulated (κ after the first map, √κ after the others: two such steps reach the area
/// distortion of four with √κ alone). An iteration is kept only if its chart has fewer folds, or as
/// few (none, but for rounding) and the mean |ln area ratio| falls; else the map before it is the
/// result.
/// Our own, after the paper's Sections 3 and 4; bijective in the chart by Tutte's theorem on a
/// cylinder. The lift's few folds are the business of certificate and untangling.
///
/// Requires: usable poles; an induced date line from pole to pole; coordinates whose fourth powers
/// neither overflow nor underflow.
/// Throws: SolveError; Cancelled; std::invalid_argument naming an option outside of its domain.
CurvilinearResult map_curvilinear(const TriangleMesh& mesh, const Topology& topology,
                                  DateLine date_line, const CurvilinearOptions& options = {},
                                  const Progress& progress = {});

/// With the shortest date line, made an induced path.
CurvilinearResult map_curvilinear(const TriangleMesh& mesh, const Topology& topology, Poles poles,
                                  const CurvilinearOptions& options = {},
                                  const Progress& progress = {});

}  // namespace sphparam
