// `sphparam paint`: an equirectangular image onto a mesh, the way back of `bake`: as colours of its
// vertices, or as a texture for its own coordinates.

#include "sphparam/paint/paint.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "commands/command.h"
#include "commands/mapped_source.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/paths.h"
#include "io/attributes/appearance.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Put an equirectangular image on a mesh: as colours, or into its own texture.\n"
    "\n"
    "Examples:\n"
    "  sphparam paint statue.sph.ply --image earth.png -o painted.ply\n"
    "  sphparam paint statue.obj --image earth.jpg --convention gis -o painted.obj\n"
    "  sphparam paint statue.obj --image earth.png --atlas 4096 -o statue_skin.png\n"
    "\n"
    "The image is twice as wide as high: longitude to the right, from the north pole down. Each\n"
    "vertex gets the mean of the image over its surroundings on the sphere, taken in linear "
    "light;\n"
    "with --atlas each texel of a square image does, as the mesh's texture coordinates place it,\n"
    "and colours run on over the borders of its charts. A mesh without a map is mapped first.\n";

struct PaintArguments {
  std::string input;
  std::string output;
  std::string image;
  std::string sphere;  // empty: none
  Convention convention = Convention::Sphparam;
  int atlas = 0;  // texels; 0: vertex colours
  int padding = AtlasOptions{}.padding;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

using Serialiser = std::string (*)(const MeshFile&);

Serialiser serialiser(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".ply" || is_stream(path)) return serialise_ply;
  if (extension == ".obj") return serialise_obj;
  if (extension == ".off") return serialise_off;
  throw UsageMistake("-o: colours of vertices go into a .ply, .obj or .off file, not " +
                     (extension.empty() ? "one without a name" : extension) +
                     "; an image is written with --atlas SIZE");
}

/// Before any work is done: a name that promises another format, an input that would be lost.
void require_sensible(const PaintArguments& arguments) {
  if (arguments.atlas == 0) {
    serialiser(arguments.output);
  } else if (!is_stream(arguments.output) && extension_of(arguments.output) != ".png") {
    throw UsageMistake("-o: with --atlas the picture is a PNG, the name must end in .png");
  }
  if (is_stream(arguments.input) && is_stream(arguments.image)) {
    throw UsageMistake("the mesh and --image cannot both come from standard input");
  }
  check_places({arguments.input, arguments.image, arguments.sphere}, {{"-o", arguments.output}});
}

EquirectangularImage read_picture(const PaintArguments& arguments, Console& console) {
  EquirectangularImage image =
      read_equirectangular(arguments.image, arguments.convention, arguments.threads);
  if (std::abs(image.width() - 2 * image.height()) > 1) {
    console.warning(display_name(arguments.image) + ": " + std::to_string(image.width()) + " × " +
                    std::to_string(image.height()) +
                    ": an equirectangular image of the whole sphere is twice as wide as high");
  }
  return image;
}

std::string vertex_colours(const PaintArguments& arguments, const MappedMesh& source,
                           const EquirectangularImage& image, const Progress& progress) {
  MeshFile file = paint_vertices(source, image, {arguments.threads, progress});
  const Serialiser serialise = serialiser(arguments.output);
  return serialise == serialise_ply ? serialise(file) : serialise(without_map(std::move(file)));
}

/// As the file counts its faces.
std::string face_number(const MeshFile& file, Face face) {
  const Property* source = file.find_face_property("source_face");
  return std::to_string(source ? static_cast<long>(source->values[static_cast<size_t>(face)])
                               : face);
}

void tell_overlaps(const PaintArguments& arguments, const MeshFile& file,
                   const PaintedAtlas& painted, Console& console) {
  if (painted.overlapping == 0) return;
  console.warning(display_name(arguments.input) + ": its texture coordinates overlap: " +
                  std::to_string(painted.overlapping) + " of " + std::to_string(painted.painted) +
                  " texels belong to two triangles or more (" +
                  face_number(file, painted.rivals[0]) + " and " +
                  face_number(file, painted.rivals[1]) + ", for one); the first has them");
}

std::string atlas(const PaintArguments& arguments, const MappedMesh& source,
                  const EquirectangularImage& image, const Progress& progress, Console& console) {
  try {
    const PaintedAtlas painted = paint_atlas(source, image,
                                             {.size = arguments.atlas,
                                              .padding = arguments.padding,
                                              .threads = arguments.threads,
                                              .progress = progress});
    tell_overlaps(arguments, source.file(), painted, console);
    return png_of(painted, image.has_alpha());
  } catch (const AtlasError& error) {
    throw UsageMistake(std::string("--atlas: ") + error.what());
  }
}

int run_paint(const PaintArguments& arguments) {
  require_sensible(arguments);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const OrderlyInterruption orderly;
  const MappedMesh source =
      read_mapped_source(arguments.input, arguments.sphere, arguments.threads, console);
  if (arguments.atlas > 0 && !has_texcoords(source.file())) {
    throw UsageMistake("--atlas: the mesh has no texture coordinates of its own");
  }
  const EquirectangularImage image = read_picture(arguments, console);
  const Progress progress = [&](std::string_view stage, double fraction) {
    return console.progress(stage, fraction);
  };
  std::string bytes = arguments.atlas > 0 ? atlas(arguments, source, image, progress, console)
                                          : vertex_colours(arguments, source, image, progress);
  console.clear_progress();
  if (interrupted()) throw Cancelled();
  write_file(arguments.output, std::move(bytes));
  console.say(display_name(arguments.input) + ", " + display_name(arguments.image) + " → " +
              output_name(arguments.output));
  return Ok;
}

void add_inputs(CLI::App& command, PaintArguments& arguments) {
  command.add_option("MESH", arguments.input, "A map or a mesh; - for standard input")
      ->type_name(" ")
      ->required();
  command
      .add_option("--image", arguments.image,
                  "The equirectangular image: PNG, JPEG, TIFF (sRGB) or EXR (linear)")
      ->type_name("IMAGE")
      ->required();
  std::vector<std::pair<std::string, Convention>> conventions;
  for (const ConventionInfo& info : all_conventions()) {
    conventions.emplace_back(info.name, info.convention);
  }
  add_choice<Convention>(command, "--convention", arguments.convention, conventions,
                         "Where longitude goes in the image (default: sphparam)");
  command
      .add_option("--sphere", arguments.sphere,
                  "The map in a file of its own: the same mesh on the sphere")
      ->type_name("FILE");
}

}  // namespace

Command declare_paint(CLI::App& program) {
  const auto arguments = std::make_shared<PaintArguments>();
  CLI::App* command = program.add_subcommand("paint", summary);
  add_inputs(*command, *arguments);
  command
      ->add_option("-o,--output", arguments->output,
                   "The coloured mesh (.ply, .obj, .off), or the image (.png); - for standard "
                   "output")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--atlas", arguments->atlas,
                   "Paint an image of SIZE × SIZE texels for the mesh's texture coordinates")
      ->check(between(1, 32768, "1 to 32768"))
      ->type_name("SIZE");
  command
      ->add_option("--padding", arguments->padding,
                   "How many texels colours run on over the borders of charts")
      ->check(between(0, 254, "0 to 254"))
      ->type_name("N")
      ->capture_default_str();
  add_threads(*command, arguments->threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_paint(*arguments); }};
}

}  // namespace sphparam::cli
