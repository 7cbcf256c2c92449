#pragma once

#include <functional>
#include <string>

#include "arguments/repair_arguments.h"
#include "commands/command.h"
#include "compare/methods.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/parameterize.h"

namespace sphparam::cli {

/// What the command line of `sphparam map` says.
struct MapArguments {
  std::string input;
  std::string output;
  std::string sphere;  // empty: not wanted; so are:
  std::string json;
  std::string charts;
  std::string pins;
  std::string poles = "auto";
  std::string balance = "balanced";  // a word, or the λ it stands for
  RepairArguments repair;
  bool keep_folded = false;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
  AnyMethod method = Method::Progressive;
  // Complete but for `progress` and `pins`. Vertices have their numbers in the file.
  ParameterizeOptions options;
};

/// The subcommand as declared; `settle` is to be called after parsing. It completes the arguments
/// and throws UsageMistake when they make no sense together.
struct MapDeclaration {
  CLI::App* options;
  std::function<void()> settle;
};
MapDeclaration declare_map_arguments(CLI::App& program, MapArguments& arguments);

}  // namespace sphparam::cli
