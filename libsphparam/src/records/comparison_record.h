#pragma once

#include <string>
#include <vector>

#include "compare/entry.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// Maps of one mesh side by side. References are to values that outlive the record.
struct ComparisonRecord {
  std::string command;  // "compare", "report"
  const MeshSource& source;
  const std::vector<Entry>& entries;
  double seconds = 0;
};

/// As `compare.json` has it, and `sphparam report --json`.
std::string to_json(const ComparisonRecord& record);

}  // namespace sphparam
