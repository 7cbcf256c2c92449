#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/command.h"
#include "console/console.h"
#include "sphparam/remesh/displacement.h"

namespace CLI {
class App;
}

namespace sphparam::cli {

/// The command line of `sphparam remesh`.
struct RemeshArguments {
  std::string input;
  std::string sphere;  // a map of the mesh in a file of its own
  std::string grid;
  std::string output;
  std::string transfer = "all";
  SampleMode sample = SampleMode::Point;
  std::optional<Scheme> subdivision;  // fitted to the source
  std::string limit_output;           // its points at the grid's vertices
  std::string displacement;           // image of what the fit leaves
  std::string displacement_size = "4096x2048";
  std::string rebuilt;    // mesh of fit and image
  int lods = 0;           // coarser meshes
  bool adaptive = false;  // the map relaxed so that detail gets more vertices
  std::string geometry_image;
  std::string normal_image;
  std::vector<std::string> attribute_images;  // NAME=FILE
  std::optional<ImageDepth> depth;
  std::string csv;
  std::string json;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

/// Columns and rows of --displace-size; nothing where the text names none.
struct DisplacementSize {
  int width, height;
};
std::optional<DisplacementSize> image_size_named(const std::string& text);

CLI::App* declare_remesh_arguments(CLI::App& program, RemeshArguments& arguments);

}  // namespace sphparam::cli
