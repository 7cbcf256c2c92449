// `sphparam render`: pictures of a mesh and of its map, side by side, in the same colours, so that
// one sees where each part of the shape went.

#include <stdexcept>
#include <utility>

#include "arguments/ends.h"
#include "arguments/limits.h"
#include "commands/command.h"
#include "commands/data_files.h"
#include "commands/sources.h"
#include "console/places.h"
#include "reports/told_losses.h"
#include "sphparam/io/losses.h"
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
    "  sphparam render lh.white --data lh.aparc.annot --from -1,0,0 -o parcels.png\n"
    "\n"
    "Colours: own (the texture, of --texture or of a glTF file; else the colours of vertices; else "
    "of\n"
    "materials; else normals), plain, normals, checker (of longitude and latitude), area (red "
    "grows, blue shrinks, full at a factor of 8), angle (the factor by "
    "which\n"
    "a triangle's angles are off in the mean, dark 1 to yellow 8). Instead of these, --data or "
    "--scalar\n"
    "shows a number a vertex, --scalar also one a face: labels in the colours of their table, what "
    "is\n"
    "measured on a scale.\n";

struct RenderArguments : CommonArguments {
  std::string input;
  std::string sphere;  // a map of the mesh in a file of its own; empty: none
  std::string output;
  std::string texture;  // empty: none
  std::string from;     // empty: in front, to the right, above
  std::string range;    // empty: as the numbers are
  Words data;           // numbers a vertex in files of their own
  double crease = -1;   // degrees; below 0: none
  DrawingOptions drawing = {};
  RepairArguments repair;
};

Vector3 parse_direction(const std::string& text) {
  const auto numbers = three_numbers(text);
  const Vector3 direction = numbers ? Vector3(numbers->data()) : Vector3::Zero();
  if (direction.isZero(0)) throw UsageMistake("--from: expected a direction, as in 1,-0.6,0.45");
  return direction;
}

std::pair<double, double> parse_range(const std::string& text) {
  const auto ends = two_ends(text);
  if (!ends) throw UsageMistake(std::string("--range: ") + wanted_ends);
  return *ends;
}

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

/// What there is to choose from.
std::string names_of_numbers(const MeshFile& file) {
  std::vector<std::string> names;
  for (const auto* properties : {&file.vertex_properties, &file.face_properties})
    for (const Property& property : *properties) names.push_back(property.name);
  return names.empty() ? "its vertices and faces have no numbers"
                       : "there are " + enumerated(names);
}

/// Why a number that the file has is not there; empty: it has none of that name.
std::string loss_of(const std::string& wanted, const MeshFile& file) {
  for (const std::string& loss : losses_among(file.notes))
    if (loss.find("'" + wanted + "'") != std::string::npos) return loss;
  return "";
}

/// The number a vertex or face that is shown: the one that is named, else the first of the data.
std::string shown_number(DrawnMesh& mesh, const RenderArguments& arguments, Session& session) {
  const bool shows_number = !arguments.data.empty() || !arguments.drawing.scalar.empty();
  if (shows_number && (arguments.drawing.colouring != Colouring::Own || !arguments.texture.empty()))
    throw UsageMistake(
        "--data and --scalar are colours of their own: without --colour and --texture");
  const Words attached =
      attach_data_files(mesh.file, arguments.input, arguments.data, MissingValues::Kept, session);
  const std::string& wanted = arguments.drawing.scalar;
  if (wanted.empty()) return attached.empty() ? "" : attached.front();
  if (mesh.file.find_vertex_property(wanted) || mesh.file.find_face_property(wanted)) return wanted;
  const std::string name = "--scalar: " + display_name(arguments.input);
  if (const std::string loss = loss_of(wanted, mesh.file); !loss.empty())
    throw UsageMistake(name + ": " + loss);
  throw UsageMistake(name + " has no '" + wanted + "'; " + names_of_numbers(mesh.file));
}

std::string drawn(DrawnMesh& mesh, const RenderArguments& arguments, Session& session) try {
  DrawingOptions drawing = arguments.drawing;
  drawing.scalar = shown_number(mesh, arguments, session);
  drawing.threads = session.threads();
  if (!arguments.range.empty()) drawing.range = parse_range(arguments.range);
  if (drawing.range && drawing.scalar.empty())
    throw UsageMistake("--range is the scale of --scalar or --data: name a number a vertex");
  if (!arguments.from.empty()) drawing.from = parse_direction(arguments.from);
  const bool shows_own = drawing.colouring == Colouring::Own && drawing.scalar.empty();
  if (shows_own && arguments.texture.empty()) {
    Words losses;
    add_face_colour_loss(losses, mesh.file);
    tell_losses(arguments.output, losses, session.console);
  }
  if (shows_own)
    drawing.textures = read_shown_textures(mesh.file, arguments.input, arguments.texture, session);
  if (!mesh.map) require_map(drawing);
  return draw_png(mesh.file, mesh.map, drawing);
} catch (const std::invalid_argument& error) {
  throw UsageMistake("--from: " + std::string(error.what()) + "; choose another --up");
}

DrawnMesh read_drawn(const RenderArguments& arguments, Session& session) {
  if (!wanted_repairs(arguments.repair))
    return load_drawn(arguments.input, arguments.sphere, input_limits());
  return drawn_mesh(read_mended_as_far(arguments.input, arguments.repair, session),
                    arguments.sphere, input_limits());
}

int run_render(RenderArguments& arguments) {
  require_png(arguments.output);
  require_one_stream({arguments.input, arguments.sphere}, "the mesh and --sphere");
  check_places({{"-o", arguments.output}});
  Session session(arguments);
  session.console.progress("picture", 0);
  DrawnMesh mesh = read_drawn(arguments, session);
  tell_losses_of_reading(arguments.input, mesh.file.notes, session.console);
  if (!mesh.warning.empty()) session.warn({mesh.warning});
  crease(mesh.file, arguments.input, arguments.crease, session);
  session.files.add(arguments.output, drawn(mesh, arguments, session));
  session.publish();
  session.console.say(display_name(arguments.input) + " → " + output_name(arguments.output));
  return Ok;
}

void declare_look(Declaration& command, RenderArguments& arguments) {
  DrawingOptions& drawing = arguments.drawing;
  command
      .choice("--view", drawing.view,
              {{"mesh", View::Mesh}, {"sphere", View::Sphere}, {"both", View::Both}},
              "What is drawn (default: both where there is a map)")
      .choice("--colour,--color", drawing.colouring,
              {{"own", Colouring::Own},
               {"plain", Colouring::Plain},
               {"normals", Colouring::Normals},
               {"checker", Colouring::Checker},
               {"area", Colouring::Area},
               {"angle", Colouring::Angle}},
              "See above (default: own)")
      .data(arguments.data)
      .text("--scalar", drawing.scalar, "NAME",
            "The number a vertex, or a face, that is shown as colours (default: the first of "
            "--data)")
      .text("--range", arguments.range, "MIN,MAX",
            "The scale of that number (default: its 2nd to its 98th percentile; all of whole "
            "numbers)")
      .text("--texture", arguments.texture, "IMAGE",
            "Image for the mesh's texture coordinates, instead of its own")
      .flag("--wire", drawing.wireframe, "The edges of the triangles")
      .flag("--repairs", drawing.repairs,
            "Outline what repair has closed: loops of handles, rims of filled holes")
      .flag("--graticule", drawing.graticule, "Lines of longitude and latitude")
      .flag("--occlusion", drawing.occlusion, "Darken what little light reaches")
      .flag_off("--no-legend", drawing.legend, "Without the scale of area, angle or numbers")
      .flag("--transparent", drawing.transparent, "No white background, and no scale");
}

void declare_options(Declaration& command, RenderArguments& arguments) {
  command.input("FILE", arguments.input, "A map or a mesh; - for standard input")
      .output(arguments.output, "PNG", "The picture; - for standard output")
      .sphere(arguments.sphere)
      .crease(arguments.crease);
  declare_look(command, arguments);
  command
      .text("--from", arguments.from, "X,Y,Z", "Where the eye is (default: 1,-0.6,0.45 with z up)")
      .up(arguments.drawing.up)
      .number("--size", arguments.drawing.size, "N", {16, 16384},
              "Pixels, of each side of a picture");
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

}  // namespace

Command declare_render(CLI::App& program) {
  return make_command(program, "render", summary, declare_options, run_render);
}

}  // namespace sphparam::cli
