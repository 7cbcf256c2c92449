#pragma once

#include <optional>
#include <string>

#include "reports/json_parts.h"

namespace sphparam::cli {

/// What `sphparam info` found.
struct InfoReport {
  InputReport input;
  NamedTexts provenance;                     // of a .sph.ply
  const std::optional<RepairTrial>& repair;  // of a mesh that cannot be mapped as it is
  double seconds = 0;
};

std::string to_json(const InfoReport& report);

/// Several lines for people.
std::string to_text(const InfoReport& report);

}  // namespace sphparam::cli
