#pragma once

#include <string>
#include <vector>

#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/names.h"
#include "sphparam/parameterize.h"

namespace sphparam::cli {

/// Several lines for people: every defect with its hint, indented by two.
std::string defect_list(const std::vector<MeshDefect>& defects);

/// "angle 0.55 area 0.59": the paper's means of |ln ratio|.
std::string distortion_line(const DistortionSummary& distortion);

/// "12.3", "0.00123": as many digits as people read.
std::string short_number(double value, int digits = 3);

}  // namespace sphparam::cli
