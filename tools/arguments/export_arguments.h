#pragma once

#include <string>
#include <vector>

#include "commands/command.h"
#include "console/console.h"
#include "arguments/up_option.h"
#include "gltf/export_asset.h"

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
  // Images; empty: none.
  std::string texture, normal, occlusion, textures;
  std::vector<std::string> variants;
  int image_width = 2048;  // of test images and heat maps
  bool unlit = false;
  Convention convention = Convention::Sphparam;
  bool keep_topology = false;
  int refine_poles = 1;
  ShapeKind shape = ShapeKind::Mesh;
  Morph morph = Morph::None;
  UpAxis up = UpAxis::Automatic;
  bool tangents = false, theta_phi = false, source_uv = false;
  bool embedded = false, quantise = false, compress = false;
  int lods = 0;
  LodStyle lod_style = LodStyle::Files;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

CLI::App* declare_export_arguments(CLI::App& program, ExportArguments& arguments);

/// Throws UsageMistake where options contradict each other or the format of the output.
void check_export_arguments(const ExportArguments& arguments);

}  // namespace sphparam::cli
