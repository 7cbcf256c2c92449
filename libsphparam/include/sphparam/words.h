#pragma once

#include <string>
#include <vector>

#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam {

// What was found, in words for people. `verdict` and `complaint` of a certificate are beside it.

/// Several lines: every defect with its hint, indented by two.
std::string defect_list(const std::vector<MeshDefect>& defects);

/// "kept 99.7 % of the area and 98 % of the faces, lost 0.3 % and 2 %"; empty where no component
/// was dropped.
std::string kept_line(const KeptParts& parts);

/// "angle 0.55 area 0.59": the paper's means of |ln ratio|.
std::string distortion_line(const DistortionSummary& distortion);

/// "harmonic: 0.12 s, 3 folds, angle 0.55 area 0.59"
std::string stage_line(const StageRecord& stage);

}  // namespace sphparam
