// `sphparam render`: pictures of a mesh and of its map, side by side, in the same colours, so that
// one sees where each part of the shape went.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arguments/choice.h"
#include "commands/command.h"
#include "arguments/common_options.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "sphparam/io/file_numbers.h"
#include "arguments/input_limits.h"
#include "sphparam/io/mapped_mesh.h"
#include "console/paths.h"
#include "commands/shown_textures.h"
#include "commands/source.h"
#include "arguments/up_option.h"
#include "sphparam/io/paths.h"
#include "image/image_codec.h"
#include "sphparam/io/connectivity.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "render/drawing_size.h"
#include "render/figure.h"
#include "render/geodesic.h"
#include "render/heat.h"
#include "render/own_paint.h"
#include "render/render.h"
#include "io/attributes/shading_normals.h"
#include "sphparam/sphere/distortion.h"

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

constexpr double margin = 1.06;  // of the picture around what is drawn

enum class View { Mesh, Sphere, Both };
enum class Colouring { Own, Plain, Normals, Checker, Area, Angle };

struct RenderArguments {
  std::string input;
  std::string sphere;  // a map of the mesh in a file of its own; empty: none
  std::string output;
  std::string texture;  // empty: none
  std::optional<View> view;
  Colouring colouring = Colouring::Own;
  std::string from = "";  // empty: in front, to the right, above
  std::optional<Up> up;
  bool wire = false;
  bool graticule = false;
  bool occlusion = false;
  bool no_legend = false;
  int size = 800;
  int threads = 0;
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
  MeshTextures textures;

  const SphereMap& required_map(const char* why) const {
    if (!map) throw UsageMistake(std::string(why) + " needs a map: run `sphparam map` first");
    return *map;
  }
};

/// What a colouring measures, where it measures something.
std::optional<Heat> heat_of(Colouring colouring) {
  if (colouring == Colouring::Area) return Heat::Area;
  if (colouring == Colouring::Angle) return Heat::Angle;
  return std::nullopt;
}

Paint make_paint(const Subject& subject, const RenderArguments& arguments) {
  switch (arguments.colouring) {
    case Colouring::Own:
      return own_paint(subject.file, subject.textures);
    case Colouring::Plain:
      return UniformPaint{};
    case Colouring::Normals:
      return direction_paint(subject.file.mesh);
    case Colouring::Checker:
      return CheckerPaint{.rays = subject.required_map("--colour checker").points};
    case Colouring::Area:
    case Colouring::Angle:
      return heat_paint(
          *heat_of(arguments.colouring),
          measure_distortion(subject.file.mesh, subject.required_map("this colouring"),
                             arguments.threads));
  }
  return UniformPaint{};
}

/// Where the eye is: as asked for, or in front, to the right and above, whatever axis is up.
Vector3 eye(const RenderArguments& arguments, Up up) {
  if (!arguments.from.empty()) return parse_direction(arguments.from);
  return up == Up::Y ? Vector3(1, 0.45, 0.6) : Vector3(1, -0.6, 0.45);
}

enum class Shape { Mesh, Sphere };

/// Looks at the middle of what is seen from there, all of it in the picture. North is up on the
/// sphere: it is seen from where the mesh is once its axis has been turned to z.
Camera framing(Shape shape, const Points& points, Up up, const RenderArguments& arguments) {
  Camera camera;
  camera.direction = eye(arguments, up).normalized();
  camera.up = direction_of(up);
  if (shape == Shape::Sphere && up == Up::Y) {
    camera.direction = Vector3(camera.direction.x(), -camera.direction.z(), camera.direction.y());
    camera.up = direction_of(Up::Z);
  }
  if (camera.up.cross(camera.direction).isZero()) {
    throw UsageMistake("--from: this is the direction that is up; choose another --up");
  }
  const Vector3 right = camera.up.cross(camera.direction).normalized();
  const Vector3 above = camera.direction.cross(right);
  Eigen::Matrix3d axes;  // columns
  axes << right, above, camera.direction;
  const Points seen = points * axes;
  const Vector3 lower = seen.colwise().minCoeff(), upper = seen.colwise().maxCoeff();
  camera.target = axes * (lower + upper) / 2;
  camera.height = margin * (upper - lower).head<2>().maxCoeff();
  return camera;
}

Image draw(Shape shape, const Paint& paint, const Subject& subject,
           const RenderArguments& arguments) {
  RenderObject object = {
      .mesh = subject.file.mesh, .normals = shading_normals(subject.file), .paint = paint};
  object.occlusion = arguments.occlusion;
  if (arguments.wire) object.wireframe = Wireframe{};
  if (arguments.graticule) {
    object.graticule = Graticule{.rays = subject.required_map("--graticule").points};
  }
  if (shape == Shape::Sphere) {
    object = on_sphere(object, normalised(subject.required_map("--view sphere").points).points);
  }
  return render({.objects = {object},
                 .camera = framing(shape, object.mesh.positions, arguments.up.value_or(up_axis(subject.file)),
                                   arguments),
                 .width = arguments.size,
                 .height = arguments.size},
                arguments.threads);
}

Image picture(const Subject& subject, const RenderArguments& arguments) {
  const View view = arguments.view.value_or(subject.map ? View::Both : View::Mesh);
  const Paint paint = make_paint(subject, arguments);
  const auto drawn = [&](Shape shape) { return draw(shape, paint, subject, arguments); };
  const Image image = view == View::Mesh     ? drawn(Shape::Mesh)
                      : view == View::Sphere ? drawn(Shape::Sphere)
                                             : in_a_row({drawn(Shape::Mesh), drawn(Shape::Sphere)});
  const std::optional<Heat> heat = heat_of(arguments.colouring);
  return heat && !arguments.no_legend ? with_legend(image, *heat) : image;
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

int run_render(const RenderArguments& arguments) {
  require_png(arguments.output);
  if (is_stream(arguments.input) && is_stream(arguments.sphere)) {
    throw UsageMistake("the mesh and --sphere cannot both come from standard input");
  }
  check_places({arguments.input, arguments.sphere, arguments.texture}, {{"-o", arguments.output}});
  Console console(arguments.loudness.verbosity(), arguments.progress);
  console.progress("picture", 0);
  Subject subject = read_subject(arguments);
  if (arguments.colouring == Colouring::Own) {
    subject.textures = shown_textures(subject.file, arguments.input, arguments.texture,
                                      arguments.threads, console);
  }
  const std::vector<char> png = encode_image(picture(subject, arguments), ImageFormat::Png);
  write_file(arguments.output, {png.data(), png.size()});
  console.say(display_name(arguments.input) + " → " + output_name(arguments.output));
  return Ok;
}

void add_look(CLI::App& command, RenderArguments& arguments) {
  add_choice<std::optional<View>>(
      command, "--view", arguments.view,
      {{"mesh", View::Mesh}, {"sphere", View::Sphere}, {"both", View::Both}},
      "What is drawn (default: both where there is a map)");
  add_choice<Colouring>(command, "--colour,--color", arguments.colouring,
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
  command.add_flag("--wire", arguments.wire, "The edges of the triangles");
  command.add_flag("--graticule", arguments.graticule, "Lines of longitude and latitude");
  command.add_flag("--occlusion", arguments.occlusion, "Darken what little light reaches");
  command.add_flag("--no-legend", arguments.no_legend, "Without the scale of area or angle");
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
  add_up(*command, arguments->up);
  command->add_option("--size", arguments->size, "Pixels, of each side of a picture")
      ->check(between(16, 16384, "16 to 16384"))
      ->type_name("N")
      ->capture_default_str();
  add_threads(*command, arguments->threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_render(*arguments); }};
}

}  // namespace sphparam::cli
