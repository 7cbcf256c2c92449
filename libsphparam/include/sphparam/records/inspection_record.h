#pragma once

#include <optional>
#include <string>

#include "sphparam/io/mesh_source.h"
#include "sphparam/io/repair_advice.h"

namespace sphparam {

/// What a mesh file holds, and all that is wrong with it. The reference is to a value that outlives
/// the record.
struct InspectionRecord {
  const MeshSource& source;
  std::optional<RepairTrial> repair = {};  // of a mesh that cannot be mapped as it is
  double seconds = 0;
  std::optional<PartsTrial> parts = {};  // where components must be chosen from
};

/// As `sphparam info --json` tells it.
std::string to_json(const InspectionRecord& record);

/// Several lines for people.
std::string to_text(const InspectionRecord& record);

}  // namespace sphparam
