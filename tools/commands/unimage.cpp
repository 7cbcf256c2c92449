// `sphparam unimage`: a geometry image back to the mesh it was made of, with its map.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include "sphparam/io/certified_files.h"
#include "arguments/choice.h"
#include "commands/command.h"
#include "arguments/common_options.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/paths.h"
#include "reports/wording.h"
#include "sphparam/io/paths.h"
#include "image/image_codec.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "remesh/geometry_image.h"
#include "sphparam/errors.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/version.h"

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

/// More than 10 million vertices in float take.
constexpr ImageLimits large_image = {.decoded_megabytes = 4096};

using Names = std::vector<std::string>;

ImageContents read_contents(const std::string& path, int threads) {
  ImageTexts texts;
  const Image image = read_image(path, large_image, &texts);
  try {
    return read_geometry_image(image, texts, threads);
  } catch (const std::invalid_argument& error) {
    throw ImageError(path + ": no geometry image: " + error.what());
  }
}

/// Properties of these names from an image of the same grid. Whole numbers from 0 to 255 of colours
/// are bytes again.
void add_properties(MeshFile& file, const GridSpec& spec, const std::string& path,
                    const Names& names, bool colour, int threads) {
  const ImageContents contents = read_contents(path, threads);
  if (contents.spec != spec || contents.channels != static_cast<int>(names.size())) {
    throw ImageError(path + ": not " + std::to_string(names.size()) + " channels of " +
                     name_of(spec));
  }
  const bool bytes =
      colour && std::all_of(contents.values.begin(), contents.values.end(),
                            [](double x) { return holds_exactly(ScalarType::Uint8, x); });
  const auto count = static_cast<size_t>(file.mesh.vertex_count());
  for (size_t k = 0; k < names.size(); ++k) {
    Property property{names[k], bytes ? ScalarType::Uint8 : ScalarType::Float32,
                      std::vector<double>(count)};
    for (size_t v = 0; v < count; ++v) property.values[v] = contents.values[v * names.size() + k];
    file.set_vertex_property(std::move(property));
  }
}

void add_attributes(MeshFile& file, const GridSpec& spec, const UnimageArguments& arguments) {
  if (!arguments.normals.empty()) {
    add_properties(file, spec, arguments.normals, {"nx", "ny", "nz"}, false, arguments.threads);
  }
  for (const std::string& text : arguments.attributes) {
    const size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos) {
      throw UsageMistake("--attribute: expected NAME=FILE, not " + text);
    }
    const std::string name = text.substr(0, equals), path = text.substr(equals + 1);
    const bool colour = name == "color" || name == "colour";
    add_properties(file, spec, path, colour ? Names{"red", "green", "blue"} : Names{name}, colour,
                   arguments.threads);
  }
}

MeshFile mesh_of(const ImageContents& contents, const UnimageArguments& arguments) {
  if (contents.channels != 3) {
    throw ImageError(arguments.input + ": positions have 3 channels, this has " +
                     std::to_string(contents.channels));
  }
  MeshFile file;
  file.position_type = ScalarType::Float32;
  file.mesh.positions =
      Eigen::Map<const Points>(contents.values.data(), contents.grid.directions.rows(), 3);
  adopt_triangulation(file, triangulate(file.mesh.positions, contents.grid.faces));
  add_attributes(file, contents.spec, arguments);
  return file;
}

void add_mesh(PendingFiles& files, MeshFile file, const Topology& topology,
              const ImageContents& contents, const UnimageArguments& arguments) {
  MeshFile with_map = attach_map(std::move(file), SphereMap{contents.grid.directions},
                                 {{"version", version},
                                  {"method", "unimage"},
                                  {"grid", name_of(contents.spec)},
                                  {"verdict", "one-to-one"}});
  add_mapped(files, arguments.output, std::move(with_map), contents.grid.faces, topology,
             arguments.threads);
}

int run_unimage(const UnimageArguments& arguments) {
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const std::string kind = is_stream(arguments.output) ? ".ply" : extension_of(arguments.output);
  if (kind != ".ply" && kind != ".obj") throw UsageMistake("-o: written are .ply and .obj");
  check_places({arguments.input, arguments.normals}, {{"-o", arguments.output}});
  const OrderlyInterruption orderly;
  console.progress("read", 0);
  const ImageContents contents = read_contents(arguments.input, arguments.threads);
  MeshFile file = mesh_of(contents, arguments);
  const Topology topology(file.mesh, arguments.threads);
  require_certified(certify(topology, SphereMap{contents.grid.directions}, arguments.threads),
                    name_of(contents.spec));
  if (interrupted()) throw Cancelled();
  console.progress("write", 0);
  PendingFiles files;
  add_mesh(files, std::move(file), topology, contents, arguments);
  if (interrupted()) throw Cancelled();
  files.publish();
  console.clear_progress();
  console.say(display_name(arguments.input) + ": " + name_of(contents.spec) + ", " +
              std::to_string(contents.grid.directions.rows()) +
              " vertices, certified one-to-one → " + output_name(arguments.output));
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
