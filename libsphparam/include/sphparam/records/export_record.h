#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/gltf/export.h"
#include "sphparam/remesh/levels_of_detail.h"

namespace sphparam {

/// What was exported.
struct ExportRecord {
  std::string input = {};                 // the file of the mesh
  std::vector<ChartFigures> charts = {};  // of the levels, finest first
  int lods_wanted = 0, lods = 0;          // coarser levels, asked for and there
  /// Of the coarser levels, from the mesh; none of those that it cannot be told of.
  std::vector<std::optional<LevelOfDetail::Distance>> distances = {};
  std::vector<FacesInSpace> in_space = {};  // of the coarser levels
  double diagonal = 0;                      // of the mesh: what distances are told against
  WrittenFiles outputs = {};
  std::vector<TextureFigures> textures = {};  // of what is seen, and of the variants
  double seconds = 0;
};

/// As `sphparam export --json` tells it.
std::string to_json(const ExportRecord& record);

/// Coarser levels that cross themselves in space, a line each: not what is wrong with their charts.
std::vector<std::string> warnings_of(const ExportRecord& record);

/// For people: how near each coarser level is, a line each, if there are any.
std::vector<std::string> level_lines(const ExportRecord& record);

}  // namespace sphparam
