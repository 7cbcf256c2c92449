#pragma once

#include <string>

#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/parameterize.h"

namespace sphparam {

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

}  // namespace sphparam
