#pragma once

#include <string>
#include <vector>

#include "compare/entry.h"
#include "reports/json_parts.h"

namespace sphparam::cli {

/// What `sphparam compare` found.
struct CompareReport {
  InputReport input;
  const std::vector<Entry>& entries;
  double seconds = 0;
};

std::string to_json(const CompareReport& report);

}  // namespace sphparam::cli
