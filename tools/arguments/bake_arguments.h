#pragma once

#include <string>
#include <vector>

#include "commands/command.h"
#include "sphparam/bake/bake.h"

namespace sphparam::cli {

struct BakeArguments {
  std::string input;
  std::string output;
  std::vector<std::string> maps;  // fields; none: the base colour
  std::string sphere;             // the map in a file of its own; empty: none
  std::string target;             // --for; empty: the source
  BakeSettings settings;          // what has an option; names, target, progress are the command's
  std::string json;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

/// Declares `sphparam bake`. The arguments must live as long as the program.
CLI::App* declare_bake_arguments(CLI::App& program, BakeArguments& arguments);

/// The images of the arguments, in their order, {map} replaced, before any work is done.
/// Throws: UsageMistake, for maps that do not exist (with the nearest), files that would be
/// written twice or are read, formats that are not written, options that do not go together.
std::vector<BakeRequest> bake_requests(const BakeArguments& arguments);

/// The library's complaint about a setting, with the option that sets it.
UsageMistake as_mistake(const BakeSettingError& error);

}  // namespace sphparam::cli
