#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/chart/chart_report.h"
#include "sphparam/io/verify_map.h"

namespace sphparam {

/// A map as somebody wrote it, proved again. The reference is to a value that outlives the record.
struct VerificationRecord {
  std::string file;
  const VerifiedMap& map;
  bool chart_wanted = false;  // it is told then that there is none
  std::optional<ChartReport> chart = {};
  double seconds = 0;
  std::string sphere = {};  // a file of its own, with the rays; empty: there is none
};

/// As `sphparam verify --json` tells it.
std::string to_json(const VerificationRecord& record);

/// Several lines for people.
std::string to_text(const VerificationRecord& record);

/// What is to be told of a map that may be one-to-one all the same: its roundness, and what its
/// file says of it that the rays do not.
std::vector<std::string> warnings_of(const VerifiedMap& map);

}  // namespace sphparam
