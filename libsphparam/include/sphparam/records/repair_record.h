#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// A mesh that was mended and written, whether it can be mapped then or not. References are to
/// values that outlive the record.
struct RepairRecord {
  const MeshSource& source;  // mended
  const RepairOptions& wanted;
  const std::vector<std::string>& losses;  // what the written format has no place for
  std::vector<std::pair<std::string, std::string>> outputs;
  double seconds = 0;
};

/// As `sphparam repair --json` tells it.
std::string to_json(const RepairRecord& record);

/// The last line for people: "can be mapped", or what still stands in the way.
std::string outcome_line(const MeshInspection& mended);

}  // namespace sphparam
