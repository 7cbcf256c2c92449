#pragma once

#include <string>
#include <vector>

#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"

namespace sphparam::tools {

/// The words of the command line and the JSON: "progressive", "mean-value", "boundary-edge", …
std::string name_of(Method method);
std::string name_of(Balance balance);
std::string name_of(Quality quality);
std::string name_of(EnergyKind energy);
std::string name_of(WeightKind weights);
std::string name_of(DefectKind kind);
std::string name_of(RepairKind kind);

/// The options that shaped a map, as on the command line: "--lambda 1".
std::string options_line(const ParameterizeOptions& options);

/// "one-to-one", "folded N" (N faces are not positive), "unusable points N", or "degree N".
std::string verdict(const Certificate& certificate);

/// Several lines for people: what is not one-to-one, with the first ids. Empty when nothing.
std::string complaint(const Certificate& certificate);

/// Several lines for people: every defect with its hint, indented by two.
std::string defect_list(const std::vector<MeshDefect>& defects);

/// "angle 0.55 area 0.59": the paper's means of |ln ratio|.
std::string distortion_line(const DistortionSummary& distortion);

/// "12.3", "0.00123": as many digits as people read.
std::string short_number(double value, int digits = 3);

}  // namespace sphparam::tools
