#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments/repair_arguments.h"
#include "sphparam/gltf/export.h"

namespace sphparam::cli {

enum class LodStyle { Files, Msft };

/// The command line of `sphparam export`.
struct ExportArguments : CommonArguments {
  std::string input;
  std::string sphere;  // a map of the mesh in a file of its own
  std::string output;
  ExportOptions exported = {};
  bool all_components = false;  // of the files that `map` made of parts
  bool embedded = false, compress = false;
  int lods = 0;
  std::vector<long> lod_faces = {};  // triangles of each level instead; they fall
  double crease = -1;                // degrees; below 0: none
  double scale = 1;                  // of lengths
  std::string scalar;                // of the vertices, which is seen as colours; empty: none
  std::optional<std::pair<double, double>> range;  // of its colours
  LodStyle lod_style = LodStyle::Files;
  RepairArguments repair;

  int levels() const { return lod_faces.empty() ? lods : static_cast<int>(lod_faces.size()); }
};

void declare_export_options(Declaration& command, ExportArguments& arguments);

/// Throws UsageMistake where options contradict each other or the format of the output.
void check_export_arguments(const ExportArguments& arguments);

}  // namespace sphparam::cli
