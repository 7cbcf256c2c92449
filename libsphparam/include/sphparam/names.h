#pragma once

#include <string>
#include <vector>

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
std::string name_of(HandleChoice choice);

/// The options that shaped a map, as on the command line: "--lambda 1".
std::string options_line(const ParameterizeOptions& options);

/// A kind of repair that is wanted or not, and its word: "holes".
struct RepairSwitch {
  const char* name;
  bool RepairOptions::*wanted;
};
/// All of them, in the order in which they are done.
const std::vector<RepairSwitch>& repair_switches();

/// The names of what is switched on.
std::vector<std::string> names_of(const RepairOptions& options);

/// What asks for these repairs where everything is wanted: "--repair --component 1 --max-hole 900".
std::string options_line(const RepairOptions& options);

}  // namespace sphparam
