// `sphparam paint`: an equirectangular image onto a mesh, the way back of `bake`: as colours of its
// vertices, or as a texture for its own coordinates.

#include "sphparam/paint/paint.h"

#include <set>
#include <utility>

#include "commands/command.h"
#include "commands/sources.h"
#include "console/places.h"
#include "io/attributes/appearance.h"
#include "io/attributes/texture_pages.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/losses.h"

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

struct PaintArguments : CommonArguments {
  std::string input;
  std::string output;
  std::string image;
  std::string sphere;  // empty: none
  Convention convention = Convention::Sphparam;
  int atlas = 0;  // texels; 0: vertex colours
  int padding = AtlasOptions{}.padding;
  RepairArguments repair;
};

void require_coloured_format(const std::string& path) {
  const std::string extension = inner_extension_of(path);
  const Words with_colours = {".ply", ".obj", ".off", ".vtk", ".vtp", ".mz3"};
  if (std::ranges::find(with_colours, extension) != with_colours.end() || is_stream(path)) return;
  throw UsageMistake("-o: colours of vertices go into a " + joined(with_colours) + " file, not " +
                     (extension.empty() ? "one without a name" : extension) +
                     "; an image is written with --atlas SIZE");
}

/// Before any work is done: a name that promises another format, an input that would be lost.
void require_sensible(const PaintArguments& arguments) {
  if (arguments.atlas == 0) {
    require_coloured_format(arguments.output);
  } else if (!is_stream(arguments.output) && extension_of(arguments.output) != ".png") {
    throw UsageMistake("-o: with --atlas the picture is a PNG, the name must end in .png");
  }
  require_one_stream({arguments.input, arguments.image}, "the mesh and --image");
  check_places({{"-o", arguments.output}});
}

EquirectangularImage read_picture(const PaintArguments& arguments, const MappedMesh& source,
                                  Console& console) try {
  EquirectangularImage image =
      read_equirectangular(arguments.image, arguments.convention, arguments.threads);
  for (const std::string& warning :
       {warning_of_shape(arguments.image, image.width(), image.height()), image.warning(),
        warning_of_map(display_name(arguments.image), image, source)})
    if (!warning.empty()) console.warning(warning);
  return image;
} catch (const ImageOfOtherConvention& error) {
  throw UsageMistake(std::string("--convention: ") + error.what());
}

/// One image cannot be what lay on several: their charts are upon each other.
void tell_pages(const PaintArguments& arguments, const MeshFile& file, Console& console) {
  std::set<std::string> images;
  for (const MaterialTexture& colour : file.base_colours)
    if (!colour.image.empty()) images.insert(colour.image);
  if (images.size() < 2) return;
  const std::string mesh = is_stream(arguments.input) ? "MESH" : shell_file(arguments.input),
                    image = is_stream(arguments.image) ? "IMAGE" : shell_file(arguments.image);
  console.warning(display_name(arguments.input) + ": its texture is of " +
                  std::to_string(images.size()) +
                  " images, and this is one for all of them, in which their charts lie upon each "
                  "other: `sphparam export " +
                  mesh + " --image " + image +
                  " -o FILE.glb` shows it by texture coordinates of its own, paint without --atlas "
                  "as colours of vertices");
}

std::string atlas(const PaintArguments& arguments, const MappedMesh& source,
                  const EquirectangularImage& image, Session& session) try {
  tell_pages(arguments, source.file(), session.console);
  const PaintedAtlas painted = paint_atlas(source, image,
                                           {.size = arguments.atlas,
                                            .padding = arguments.padding,
                                            .threads = session.threads(),
                                            .progress = session.progress()});
  const std::string warning = overlap_warning(painted, source.file());
  if (!warning.empty()) session.console.warning(display_name(arguments.input) + ": " + warning);
  return png_of(painted, image.has_alpha());
} catch (const AtlasError& error) {
  throw UsageMistake(std::string("--atlas: ") + error.what());
}

/// Adds the mesh with its colours. Returns what of it is left out, or has no place in the format.
Words add_coloured_mesh(const PaintArguments& arguments, const MappedMesh& source,
                        const EquirectangularImage& image, Session& session) {
  Words losses = add_mesh(session.files, arguments.output,
                          paint_vertices(source, image, {session.threads(), session.progress()}),
                          {.origin = arguments.input});
  if (has_textures(source.file()))
    add_loss(losses, "its own texture, which would be seen instead of the colours");
  return losses;
}

/// The mesh with its map; what it lacks is told before it is mapped.
MappedMesh read_painted(const PaintArguments& arguments, Session& session) {
  session.hold_signals();
  MeshSource source = read_mended(arguments.input, arguments.repair, session);
  if (arguments.atlas > 0 && !has_texcoords(source.file))
    throw UsageMistake("--atlas: the mesh has no texture coordinates of its own");
  tell_replaced(source, session.console);
  return map_source(std::move(source), arguments.sphere, session, arguments.repair);
}

int run_paint(PaintArguments& arguments) {
  require_sensible(arguments);
  require_there({arguments.input, arguments.image, arguments.sphere});
  Session session(arguments);
  const MappedMesh source = read_painted(arguments, session);
  tell_longitudes(source, arguments.convention, false, std::nullopt, session);
  const EquirectangularImage image = read_picture(arguments, source, session.console);
  Words losses;
  if (arguments.atlas > 0) {
    session.files.add(arguments.output, atlas(arguments, source, image, session));
  } else {
    losses = add_coloured_mesh(arguments, source, image, session);
  }
  session.publish();
  tell_losses(arguments.output, losses, session.console);
  session.console.say(display_name(arguments.input) + ", " + display_name(arguments.image) + " → " +
                      output_name(arguments.output));
  return Ok;
}

void declare_options(Declaration& command, PaintArguments& arguments) {
  command.input("MESH", arguments.input, "A map or a mesh; - for standard input")
      .text("--image", arguments.image, "IMAGE",
            "The equirectangular image: PNG, JPEG, WebP, TIFF, BMP, TGA (sRGB; floats: linear) or "
            "EXR (linear)")
      .required()
      .convention(arguments.convention)
      .sphere(arguments.sphere)
      .output(arguments.output, "FILE",
              "The coloured mesh (.ply, .obj, .off), or the image (.png); - for standard output")
      .number("--atlas", arguments.atlas, "SIZE", {1, 32768},
              "Paint an image of SIZE × SIZE texels for the mesh's texture coordinates")
      .number("--padding", arguments.padding, "N", {0, 254},
              "How many texels colours run on over the borders of charts");
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

}  // namespace

Command declare_paint(CLI::App& program) {
  return make_command(program, "paint", summary, declare_options, run_paint);
}

}  // namespace sphparam::cli
