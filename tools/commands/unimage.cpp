// `sphparam unimage`: a geometry image back to the mesh it was made of, with its map.

#include <CLI/CLI.hpp>
#include <memory>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "commands/command.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/paths.h"
#include "sphparam/errors.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/remesh/geometry_image.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Turn a geometry image back into the mesh it was made of.\n"
    "\n"
    "Examples:\n"
    "  sphparam remesh statue.sph.ply --grid octa:257 --geometry-image gi.exr\n"
    "  sphparam unimage gi.exr -o statue_octa.sph.ply\n"
    "  sphparam unimage gi.exr --attribute thickness=thickness.exr -o statue_octa.sph.ply\n"
    "\n"
    "The image names its grid; vertices and faces are those of `remesh --grid`. Where samples of\n"
    "one vertex differ, the image was changed on one side of its cut, and is refused.\n";

struct UnimageArguments {
  std::string input;
  std::string output;
  std::string normals;
  std::vector<std::string> attributes;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

GeometryImageFiles files_of(const UnimageArguments& arguments) {
  GeometryImageFiles files{.positions = arguments.input, .normals = arguments.normals};
  for (const std::string& text : arguments.attributes) {
    const size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw UsageMistake("--attribute: expected NAME=FILE, not " + text);
    }
    files.attributes.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return files;
}

int run_unimage(const UnimageArguments& arguments) {
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const std::string kind = is_stream(arguments.output) ? ".ply" : extension_of(arguments.output);
  if (kind != ".ply" && kind != ".obj") throw UsageMistake("-o: written are .ply and .obj");
  check_places({arguments.input, arguments.normals}, {{"-o", arguments.output}});
  const OrderlyInterruption orderly;
  const Remeshed mesh = load_geometry_image(
      files_of(arguments), arguments.threads,
      [&](std::string_view stage, double f) { return console.progress(stage, f); });
  console.progress("write", 0);
  PendingFiles files;
  add_mapped(files, arguments.output, mesh, arguments.threads);
  if (interrupted()) throw Cancelled();
  files.publish();
  console.clear_progress();
  console.say(display_name(arguments.input) + ": " + mesh.name() + ", " +
              std::to_string(mesh.mesh().vertex_count()) + " vertices, certified one-to-one → " +
              output_name(arguments.output));
  return Ok;
}

}  // namespace

Command declare_unimage(CLI::App& program) {
  const auto arguments = std::make_shared<UnimageArguments>();
  CLI::App* command = program.add_subcommand("unimage", summary);
  command->add_option("IMAGE", arguments->input, "Positions, .exr or .png, as `remesh` makes them")
      ->type_name(" ")
      ->required();
  command->add_option("-o,--output", arguments->output, "The mesh: .ply with its map, or .obj")
      ->type_name("FILE")
      ->required();
  command->add_option("--normals", arguments->normals, "The image of the normals")
      ->type_name("FILE");
  command
      ->add_option("--attribute", arguments->attributes,
                   "An image of a property, as in thickness=FILE or color=FILE; may be given again")
      ->type_name("NAME=FILE")
      ->expected(1)
      ->take_all();
  add_threads(*command, arguments->threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_unimage(*arguments); }};
}

}  // namespace sphparam::cli
