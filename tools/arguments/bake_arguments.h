#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/command.h"
#include "sphparam/bake/fields.h"
#include "sphparam/bake/interpolation.h"
#include "sphparam/image/image_format.h"
#include "sphparam/texture/convention.h"
#include "sphparam/texture/texture_options.h"

namespace sphparam::cli {

struct BakeArguments {
  std::string input;
  std::string output;
  std::vector<std::string> maps;
  std::string texture;  // empty: none
  TextureWrap wrap = TextureWrap::Repeat;
  std::string sphere;  // the map in a file of its own; empty: none
  std::string target;  // --for; empty: the source
  int width = 2048;
  int samples = 1;
  Interpolation interpolation = Interpolation::Uv;
  int refine_poles = 1;
  Convention convention = Convention::Sphparam;
  std::optional<SampleType> depth;
  bool mip = false;
  FieldOptions options;
  std::string json;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

/// Declares `sphparam bake`. The arguments must live as long as the program.
CLI::App* declare_bake_arguments(CLI::App& program, BakeArguments& arguments);

/// One image that is asked for.
struct BakeOutput {
  std::string map;  // as the user wrote it
  std::string path;
};

/// Where the scale of a heat map goes: heat.png has it in heat_scale.png beside it.
std::string scale_path(const std::string& image);

/// The images of the arguments, in their order, {map} replaced, before any work is done.
/// Throws: UsageMistake, for maps that do not exist (with the nearest), files that would be
/// written twice or are read, formats that are not written, options that do not go together.
std::vector<BakeOutput> bake_outputs(const BakeArguments& arguments);

}  // namespace sphparam::cli
