// `sphparam render`: pictures of a mesh and of its map, side by side, in the same colours, so that
// one sees where each part of the shape went. The only subcommand that opens the image module.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/choice.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/input_limits.h"
#include "cli/paths.h"
#include "image/file_extension.h"
#include "image/image_codec.h"
#include "mesh_io/mesh_reader.h"
#include "mesh_io/safe_file.h"
#include "mesh_io/sphere_file.h"
#include "render/drawing_size.h"
#include "render/figure.h"
#include "render/geodesic.h"
#include "render/heat.h"
#include "render/render.h"
#include "render/vertex_normals.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam::tools {

namespace {

constexpr char summary[] =
    "Draw a mesh and its map as a PNG.\n"
    "\n"
    "Examples:\n"
    "  sphparam render statue.sph.ply -o statue.png\n"
    "  sphparam render statue.sph.ply -o area.png --colour area --wire\n"
    "  sphparam render statue.sph.ply -o ball.png --view sphere --colour checker --size 1200\n"
    "  sphparam render statue.obj -o front.png --texture statue_skin.png --from 1,0,0.3 --up y\n"
    "\n"
    "Colours: own (texture or vertex colours; else normals), plain, normals, checker (of "
    "longitude\n"
    "and latitude), area (red grows, blue shrinks, full at a factor of 8), angle (the factor by "
    "which\n"
    "a triangle's angles are off in the mean, dark 1 to yellow 8).\n";

constexpr double margin = 1.06;  // of the picture around what is drawn

enum class View { Mesh, Sphere, Both };
enum class Colouring { Own, Plain, Normals, Checker, Area, Angle };

struct RenderArguments {
  std::string input;
  std::string output;
  std::string texture;  // empty: none
  std::optional<View> view;
  Colouring colouring = Colouring::Own;
  std::string from = "";  // empty: in front, to the right, above
  Vector3 up = Vector3::UnitZ();
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

/// Colours of vertices as the file has them, Uint8 or Float32.
std::optional<VertexPaint> own_colours(const MeshFile& file) {
  std::array<const Property*, 3> channels = {file.find_vertex_property("red"),
                                             file.find_vertex_property("green"),
                                             file.find_vertex_property("blue")};
  if (std::count(channels.begin(), channels.end(), nullptr) > 0) return std::nullopt;
  VertexPaint paint;
  paint.colours.resize(static_cast<size_t>(file.mesh.vertex_count()));
  for (int channel = 0; channel < 3; ++channel) {
    const Property& property = *channels[static_cast<size_t>(channel)];
    const bool is_float =
        property.type == ScalarType::Float32 || property.type == ScalarType::Float64;
    const double full = is_float ? 1 : 255;
    for (size_t v = 0; v < paint.colours.size(); ++v) {
      paint.colours[v][channel] =
          static_cast<float>(std::clamp(property.values[v] / full, 0.0, 1.0));
    }
  }
  return paint;
}

/// Each direction of the surface has its own pastel colour: features stay recognisable wherever
/// they are mapped to.
VertexPaint normal_colours(const TriangleMesh& mesh) {
  VertexPaint paint;
  const Points normals = vertex_normals(mesh);  // named: it must outlive the loop
  for (const auto& normal : normals.rowwise()) {
    paint.colours.push_back((0.7 + 0.25 * normal.array()).cast<float>().matrix().transpose());
  }
  return paint;
}

/// What is drawn: a mesh and, where it is known, its map.
struct Subject {
  MeshFile file;
  std::optional<SphereMap> map;

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

Paint own_paint(const Subject& subject, const std::string& texture) {
  if (!texture.empty()) {
    if (!subject.file.corner_texcoords) {
      throw UsageMistake("--texture: the mesh has no texture coordinates at its corners");
    }
    return TexturePaint{*subject.file.corner_texcoords, read_image(texture)};
  }
  if (const auto colours = own_colours(subject.file)) return *colours;
  return normal_colours(subject.file.mesh);
}

Paint make_paint(const Subject& subject, const RenderArguments& arguments) {
  switch (arguments.colouring) {
    case Colouring::Own:
      return own_paint(subject, arguments.texture);
    case Colouring::Plain:
      return UniformPaint{};
    case Colouring::Normals:
      return normal_colours(subject.file.mesh);
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
Vector3 eye(const RenderArguments& arguments) {
  if (!arguments.from.empty()) return parse_direction(arguments.from);
  return arguments.up.y() == 1 ? Vector3(1, 0.45, 0.6) : Vector3(1, -0.6, 0.45);
}

/// Looks at the middle of what is seen from there, all of it in the picture.
Camera framing(const Points& points, const RenderArguments& arguments) {
  Camera camera;
  camera.direction = eye(arguments).normalized();
  camera.up = arguments.up;
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

enum class Shape { Mesh, Sphere };

Image draw(Shape shape, const Paint& paint, const Subject& subject,
           const RenderArguments& arguments) {
  RenderObject object = {.mesh = subject.file.mesh, .paint = paint};
  object.occlusion = arguments.occlusion;
  if (arguments.wire) object.wireframe = Wireframe{};
  if (arguments.graticule) {
    object.graticule = Graticule{.rays = subject.required_map("--graticule").points};
  }
  if (shape == Shape::Sphere) {
    object = on_sphere(object, normalised(subject.required_map("--view sphere").points).points);
  }
  return render({.objects = {object},
                 .camera = framing(object.mesh.positions, arguments),
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

int run_render(const RenderArguments& arguments) {
  require_png(arguments.output);
  check_places({arguments.input}, {{"-o", arguments.output}});
  Console console(arguments.loudness.verbosity(), arguments.progress);
  console.progress("picture", 0);
  Subject subject = {.file = read_mesh(arguments.input, input_limits()), .map = std::nullopt};
  if (subject.file.mesh.face_count() == 0) {
    throw ReadError(display_name(arguments.input), "there are no triangles to draw");
  }
  subject.map = read_sphere(subject.file);
  subject.file.mesh = at_drawing_size(std::move(subject.file.mesh));
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
  command.add_option("--texture", arguments.texture, "Image for the mesh's texture coordinates")
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
  add_look(*command, *arguments);
  command
      ->add_option("--from", arguments->from, "Where the eye is (default: 1,-0.6,0.45 with z up)")
      ->type_name("X,Y,Z");
  add_choice<Vector3>(*command, "--up", arguments->up,
                      {{"z", Vector3::UnitZ()}, {"y", Vector3::UnitY()}},
                      "The axis that points up (default: z)");
  command->add_option("--size", arguments->size, "Pixels, of each side of a picture")
      ->check(between(16, 16384, "16 to 16384"))
      ->type_name("N")
      ->capture_default_str();
  add_threads(*command, arguments->threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_render(*arguments); }};
}

}  // namespace sphparam::tools
