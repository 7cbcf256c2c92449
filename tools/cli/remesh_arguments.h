#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/command.h"
#include "cli/console.h"
#include "remesh/geometry_image.h"
#include "remesh/remesh.h"

namespace CLI {
class App;
}

namespace sphparam::tools {

/// The command line of `sphparam remesh`.
struct RemeshArguments {
  std::string input;
  std::string sphere;  // a map of the mesh in a file of its own
  std::string grid;
  std::string output;
  std::string transfer = "all";
  SampleMode sample = SampleMode::Point;
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

CLI::App* declare_remesh_arguments(CLI::App& program, RemeshArguments& arguments);

}  // namespace sphparam::tools
