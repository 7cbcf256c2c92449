#pragma once

#include <string>

#include "commands/command.h"
#include "console/console.h"
#include "sphparam/gltf/export.h"

namespace CLI {
class App;
}

namespace sphparam::cli {

enum class LodStyle { Files, Msft };

/// The command line of `sphparam export`.
struct ExportArguments {
  std::string input;
  std::string sphere;  // a map of the mesh in a file of its own
  std::string output;
  std::string json;
  ExportOptions exported = {};
  bool embedded = false, compress = false;
  int lods = 0;
  LodStyle lod_style = LodStyle::Files;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

CLI::App* declare_export_arguments(CLI::App& program, ExportArguments& arguments);

/// Throws UsageMistake where options contradict each other or the format of the output.
void check_export_arguments(const ExportArguments& arguments);

}  // namespace sphparam::cli
