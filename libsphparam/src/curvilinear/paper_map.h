#pragma once

#include <functional>
#include <string>
#include <vector>

#include "curvilinear/tangential_smoothing.h"
#include "sphparam/mesh/edge_weights.h"
#include "sphparam/progress.h"

namespace sphparam {

struct PaperOptions {
  double epsilon = 0.02;  // radians from poles to rims of the chart (Section 3); above 0, to 1.5
  int iterations = 3;     // of the secondary map: "two to three … largely sufficient" (Section 4)
  int rings = 5;          // of the sub-patch that is smoothed (Section 5)
  int sweeps = 3;         // of the smoothing (Section 5)
  WeightKind weights = WeightKind::MeanValue;  // or Cotangent, as in the paper
  int threads = 0;                             // 0: all cores
};

/// One stage of the paper as it came out.
struct PaperStage {
  std::string name;   // "initial", "iteration 1", …, "smoothing"
  double seconds;     // wall time of this stage alone
  long planar_folds;  // of the chart; of the last chart for the smoothing, which has none
};

struct PaperResult {
  SphereMap map;  // not certified: the paper's maps may fold
  DateLine date_line;
  double path_seconds = 0;  // date line and cut
  std::vector<PaperStage> stages;
};

/// Is shown the map after every stage. May be empty.
using StageObserver = std::function<void(const PaperStage& stage, const SphereMap& map)>;

/// Exactly what the paper prints: shortest date line, cut, harmonic map of the rectangle with all
/// sides fixed, quasi-harmonic iterations with κ of the last map, lift, poles back, tangential
/// smoothing around the date line. Nothing is repaired; folds are counted, not avoided.
/// Paper: Sections 3 to 5 and Figure 1.
/// Requires: usable poles. Throws: SolveError (raw cotangents can make a singular system);
/// Cancelled; std::invalid_argument naming an option outside of its domain (none is below 0).
PaperResult map_as_paper(const TriangleMesh& mesh, const Topology& topology, Poles poles,
                         const PaperOptions& options = {}, const Progress& progress = {},
                         const StageObserver& on_stage = {});

}  // namespace sphparam
