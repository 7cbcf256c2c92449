#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/correspondence/carried_shape.h"
#include "sphparam/correspondence/match.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam {

/// A map between two surfaces. References are to values that outlive the record.
struct MatchRecord {
  std::string first, second;  // the files
  const Match& match;
  const MatchOptions& options;
  bool mirrored = false;         // the first is the mirror image of what its file has
  DistortionSummary distortion;  // of the composition
  bool first_mapped_now = true;  // before its map was moved: no file had it
  std::optional<CarriedFidelity> carried = {};  // of the first's triangles in the second's shape
  std::vector<std::pair<std::string, std::string>> outputs = {};  // what, and its file
  double seconds = 0;
};

/// As `sphparam match --json` tells it.
std::string to_json(const MatchRecord& record);

/// A line for people.
std::string to_text(const MatchRecord& record);
/// Another one: what the first's triangles miss of the second's shape. Requires: `carried`.
std::string carried_line(const MatchRecord& record);

}  // namespace sphparam
