#pragma once

#include <string>
#include <vector>

#include "sphparam/gltf/export.h"

namespace sphparam {

/// What was exported.
struct ExportRecord {
  std::string input = {};                 // the file of the mesh
  std::vector<ChartFigures> charts = {};  // of the levels, finest first
  int lods_wanted = 0, lods = 0;          // coarser levels, asked for and there
  WrittenFiles outputs = {};
  std::vector<TextureFigures> textures = {};  // of what is seen, and of the variants
  double seconds = 0;
};

/// As `sphparam export --json` tells it.
std::string to_json(const ExportRecord& record);

}  // namespace sphparam
