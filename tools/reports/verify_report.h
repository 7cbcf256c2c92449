#pragma once

#include <optional>
#include <string>

#include "reports/json_parts.h"
#include "sphparam/io/verify_map.h"

namespace sphparam::cli {

/// What `sphparam verify` found.
struct VerifyReport {
  const std::string& file;
  const VerifiedMap& map;
  bool chart_wanted = false;  // with --chart
  std::optional<ChartReport> chart = std::nullopt;
  double seconds = 0;
};

/// Where the rays are no points of a sphere: what was judged instead, and the way out. Else empty.
std::string roundness_warning(const VerifiedMap& map);

std::string to_json(const VerifyReport& report);

/// Several lines for people.
std::string to_text(const VerifyReport& report);

}  // namespace sphparam::cli
