// `sphparam render`: pictures of a mesh and of its map, side by side, in the same colours, so that
// one sees where each part of the shape went.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "arguments/input_limits.h"
#include "arguments/up_option.h"
#include "commands/command.h"
#include "commands/shown_textures.h"
#include "commands/source.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/paths.h"
#include "render/drawing_size.h"
#include "sphparam/io/connectivity.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/render/picture.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Draw a mesh and its map as a PNG.\n"
    "\n"
    "Examples:\n"
    "  sphparam render statue.sph.ply -o statue.png\n"
    "  sphparam render statue.sph.ply -o area.png --colour area --wire\n"
    "  sphparam render statue.sph.ply -o ball.png --view sphere --colour checker --size 1200\n"
    "  sphparam render statue.obj -o front.png --texture statue_skin.png --from 1,0.3,0 --up y\n"
    "  sphparam render duck.glb --sphere duck.sph.ply -o duck.png\n"
    "\n"
    "Colours: own (the texture, of --texture or of a glTF file; else the colours of vertices; else "
    "of\n"
    "materials; else normals), plain, normals, checker (of longitude and latitude), area (red "
    "grows, blue shrinks, full at a factor of 8), angle (the factor by "
    "which\n"
    "a triangle's angles are off in the mean, dark 1 to yellow 8).\n";

struct RenderArguments {
  std::string input;
  std::string sphere;  // a map of the mesh in a file of its own; empty: none
  std::string output;
  std::string texture;  // empty: none
  std::string from;     // empty: in front, to the right, above
  DrawingOptions drawing = {};
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

Vector3 parse_direction(const std::string& text) {
  Vector3 direction;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &direction[0], &direction[1],
                               &direction[2], &rest);
  if (read != 3 || !direction.allFinite() || direction.isZero(0)) {
    throw UsageMistake("--from: expected a direction, as in 1,-0.6,0.45");
  }
  return direction;
}

/// What is drawn: a mesh and, where it is known, its map.
struct Subject {
  MeshFile file;
  std::optional<SphereMap> map;
};

/// Throws UsageMistake where something is wanted that only a map has.
void require_map(const DrawingOptions& drawing) {
  if (draws_without_map(drawing)) return;
  const char* why = drawing.colouring == Colouring::Checker ? "--colour checker"
                    : drawing.colouring == Colouring::Area || drawing.colouring == Colouring::Angle
                        ? "this colouring"
                    : drawing.graticule ? "--graticule"
                                        : "--view sphere";
  throw UsageMistake(std::string(why) + " needs a map: run `sphparam map` first");
}

/// Before any work is done: a PNG under another name would deceive whoever opens it.
void require_png(const std::string& path) {
  const std::string extension = extension_of(path);
  if (is_stream(path) || extension.empty() || extension == ".png") return;
  throw UsageMistake("-o: the picture is a PNG, the name must end in .png, not " + extension);
}

/// Of the file `--sphere`, which may have any radius, as unit rays. Throws: ReadError when its
/// connectivity is another, or a vertex lies at the centre.
SphereMap map_of_sphere(const RenderArguments& arguments, const MeshFile& mesh) {
  const MeshFile sphere = read_source(arguments.sphere).file;
  const std::string difference = connectivity_difference(mesh, sphere);
  if (!difference.empty()) {
    throw ReadError(display_name(arguments.sphere),
                    "not a sphere of " + display_name(arguments.input) + ": " + difference);
  }
  SphereMap map = read_sphere(sphere).value_or(SphereMap{sphere.mesh.positions});
  for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
    if (map.points.row(v).isZero(0)) {
      throw ReadError(display_name(arguments.sphere),
                      "vertex " +
                          std::to_string(FileNumbers(sphere).number(static_cast<Vertex>(v))) +
                          " is at the centre, in no direction");
    }
  }
  return unit_rays(std::move(map));
}

/// As the file has its vertices; where a sphere is named, welded as maps need them.
Subject read_subject(const RenderArguments& arguments) {
  Subject subject;
  const bool alone = arguments.sphere.empty();
  subject.file =
      alone ? read_mesh(arguments.input, input_limits()) : read_source(arguments.input).file;
  keep_textures(subject.file);
  if (subject.file.mesh.face_count() == 0) {
    throw ReadError(display_name(arguments.input), "there are no triangles to draw");
  }
  subject.map = alone ? read_sphere(subject.file) : map_of_sphere(arguments, subject.file);
  subject.file.mesh = at_drawing_size(std::move(subject.file.mesh));
  return subject;
}

std::string drawn(const Subject& subject, const RenderArguments& arguments, Console& console) {
  MeshTextures textures;
  if (arguments.drawing.colouring == Colouring::Own) {
    textures = shown_textures(subject.file, arguments.input, arguments.texture,
                              arguments.drawing.threads, console);
  }
  if (!subject.map) require_map(arguments.drawing);
  try {
    return draw_png(subject.file, subject.map, textures, arguments.drawing);
  } catch (const std::invalid_argument& error) {
    throw UsageMistake("--from: " + std::string(error.what()) + "; choose another --up");
  }
}

int run_render(RenderArguments arguments) {
  require_png(arguments.output);
  if (is_stream(arguments.input) && is_stream(arguments.sphere)) {
    throw UsageMistake("the mesh and --sphere cannot both come from standard input");
  }
  check_places({arguments.input, arguments.sphere, arguments.texture}, {{"-o", arguments.output}});
  Console console(arguments.loudness.verbosity(), arguments.progress);
  console.progress("picture", 0);
  const Subject subject = read_subject(arguments);
  if (!arguments.from.empty()) arguments.drawing.from = parse_direction(arguments.from);
  write_file(arguments.output, drawn(subject, arguments, console));
  console.say(display_name(arguments.input) + " → " + output_name(arguments.output));
  return Ok;
}

void add_look(CLI::App& command, RenderArguments& arguments) {
  add_choice<std::optional<View>>(
      command, "--view", arguments.drawing.view,
      {{"mesh", View::Mesh}, {"sphere", View::Sphere}, {"both", View::Both}},
      "What is drawn (default: both where there is a map)");
  add_choice<Colouring>(command, "--colour,--color", arguments.drawing.colouring,
                        {{"own", Colouring::Own},
                         {"plain", Colouring::Plain},
                         {"normals", Colouring::Normals},
                         {"checker", Colouring::Checker},
                         {"area", Colouring::Area},
                         {"angle", Colouring::Angle}},
                        "See above (default: own)");
  command
      .add_option("--texture", arguments.texture,
                  "Image for the mesh's texture coordinates, instead of its own")
      ->type_name("IMAGE");
  command.add_flag("--wire", arguments.drawing.wireframe, "The edges of the triangles");
  command.add_flag("--graticule", arguments.drawing.graticule, "Lines of longitude and latitude");
  command.add_flag("--occlusion", arguments.drawing.occlusion, "Darken what little light reaches");
  command.add_flag_callback(
      "--no-legend", [&arguments] { arguments.drawing.legend = false; },
      "Without the scale of area or angle");
}

}  // namespace

Command declare_render(CLI::App& program) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = program.add_subcommand("render", summary);
  command->add_option("FILE", arguments->input, "A map or a mesh; - for standard input")
      ->type_name(" ")
      ->required();
  command->add_option("-o,--output", arguments->output, "The picture; - for standard output")
      ->type_name("PNG")
      ->required();
  command->add_option("--sphere", arguments->sphere, "The map of the mesh, in a file of its own")
      ->type_name("FILE");
  add_look(*command, *arguments);
  command
      ->add_option("--from", arguments->from, "Where the eye is (default: 1,-0.6,0.45 with z up)")
      ->type_name("X,Y,Z");
  add_up(*command, arguments->drawing.up);
  command->add_option("--size", arguments->drawing.size, "Pixels, of each side of a picture")
      ->check(between(16, 16384, "16 to 16384"))
      ->type_name("N")
      ->capture_default_str();
  add_threads(*command, arguments->drawing.threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_render(*arguments); }};
}

}  // namespace sphparam::cli
