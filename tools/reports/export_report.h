#pragma once

#include <string>
#include <vector>

#include "sphparam/gltf/export.h"

namespace sphparam::cli {

/// What `export --json` tells.
struct ExportReport {
  std::string input;
  std::vector<ChartFigures> charts;  // of the levels, finest first
  WrittenFiles outputs;
  double seconds = 0;
};

std::string to_json(const ExportReport& report);

}  // namespace sphparam::cli
