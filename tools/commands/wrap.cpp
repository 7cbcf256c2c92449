// `sphparam wrap`: one closed surface of genus 0 about any triangles.

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "arguments/limits.h"
#include "arguments/mesh_names.h"
#include "asset/soup.h"
#include "commands/command.h"
#include "commands/surfaces.h"
#include "console/places.h"
#include "io/attributes/authorship.h"
#include "io/attributes/remarks.h"
#include "mesh/box.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/records/wrap_record.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Enclose any triangles in one closed surface that can be mapped.\n"
    "\n"
    "Examples:\n"
    "  sphparam wrap asset.glb -o wrapped.ply\n"
    "  sphparam wrap asset.glb -o wrapped.ply --resolution 256\n"
    "  sphparam wrap scan.stl -o wrapped.ply --voxel 0.5 --distance 2 --json wrap.json\n"
    "  sphparam wrap parts.obj -o wrapped.ply --largest\n"
    "  sphparam wrap asset.glb -o proxy.ply --resolution 256 --gap 0.001 --faces 50000\n"
    "\n"
    "The triangles may be open, not manifold, in many parts, and pass through one another. The\n"
    "surface lies at the distance asked for, give or take less than a voxel; holes through it are\n"
    "closed by walls a voxel thick, parts that are apart joined by bridges. All of that is told.\n";

struct WrapArguments : CommonArguments {
  std::string input, output;
  WrapOptions options;
};

void require_sensible(const WrapArguments& arguments) {
  if (arguments.options.voxel > 0 && arguments.options.resolution > 0)
    throw UsageMistake(
        "--voxel and --resolution contradict each other: both say how large a voxel is");
  require_mesh_name("-o", "the wrap", arguments.output);
  check_places({{"-o", arguments.output}, {"--json", arguments.json}});
}

/// Without the vertices that have no place, and their triangles, which is told.
MeshFile with_places_told(const std::string& path, MeshFile soup, Session& session) {
  if (soup.mesh.positions.allFinite()) return soup;
  MeshSource source;
  source.path = path;
  source.file = std::move(soup);
  source = without_lost(source);
  for (const RepairAction& dropped : source.repairs) session.console.say("  " + dropped.message);
  // Not of the soup: they have been added.
  remove_properties(source.file.vertex_properties, {"source_vertex"});
  remove_properties(source.file.face_properties, {"source_face"});
  return std::move(source.file);
}

/// Throws: UsageMistake for what of the options does not suit the mesh, ReadError for a mesh
/// without places.
Wrap wrapped(const WrapArguments& arguments, const MeshFile& soup, Session& session) try {
  WrapOptions options = arguments.options;
  options.threads = session.threads();
  options.progress = session.progress();
  return wrap_soup(soup.mesh, options);
} catch (const MeshError& error) {
  throw ReadError(display_name(arguments.input), error.defects().front().message);
} catch (const std::invalid_argument& error) {
  throw UsageMistake(std::string("--") + error.what());
}

/// Tells of a voxel or distance that is larger than all of the soup: nothing of that is seen then.
void tell_size(const MeshFile& soup, const Wrap& wrap, Session& session) {
  const double side = surface_box(soup.mesh).longest_side(),
               coarse = std::max(wrap.voxel, wrap.distance);
  if (coarse <= side) return;
  session.warn({"a " + std::string(wrap.voxel > side ? "voxel" : "distance") + " of " +
                short_number(wrap.voxel > side ? wrap.voxel : wrap.distance) +
                " is larger than all of the soup, " + short_number(side) +
                ": the wrap shows nothing of it; are both in one unit, not in mm and m?"});
}

int run_wrap(WrapArguments& arguments) {
  require_sensible(arguments);
  Session session(arguments);
  ReadOptions options = input_limits();
  options.repeated_corners = true;  // needles are as good as any triangle
  options.non_finite = true;
  const MeshFile soup =
      with_places_told(arguments.input, read_surface(arguments.input, session, options), session);
  session.hold_signals();
  const Wrap wrap = wrapped(arguments, soup, session);
  tell_size(soup, wrap, session);
  MeshFile file;
  file.mesh = wrap.mesh;
  file.comments = {"wrapped about " + display_name(arguments.input) + " at distance " +
                   shortest(wrap.distance) + ", voxel " + shortest(wrap.voxel)};
  std::ranges::copy(remarks_of(soup), std::back_inserter(file.comments));
  take_up(file, soup);
  take_authorship(file, soup);
  tell_losses(arguments.output,
              add_mesh(session.files, arguments.output, file, {.origin = arguments.input}),
              session.console);
  WrapRecord record = {arguments.input, soup, wrap, {{"mesh", arguments.output}}};
  session.console.progress("crossings", 0);
  record.crossings = crossings_of(wrap, session.threads());
  if (wrap.skin)
    record.closing_distance = closing_distance(soup.mesh, wrap.distance, session.threads());
  session.warn(warnings_of(record));
  record.seconds = session.stopwatch.seconds();
  session.add_report([&] { return to_json(record); });
  session.publish();
  for (const std::string& line : to_lines(record)) session.console.say("  " + line);
  session.console.say(
      display_name(arguments.input) + ": " + counted(wrap.mesh.face_count(), "triangle") +
      ", a closed genus-0 mesh: it can be mapped → " + output_name(arguments.output));
  return Ok;
}

void declare_options(Declaration& command, WrapArguments& arguments) {
  WrapOptions& options = arguments.options;
  const Range<double> length = {.least = std::numeric_limits<double>::denorm_min(),
                                .words = "just above 0 on"};
  command.input("SOUP", arguments.input, readable_formats("or") + "; - for standard input")
      .output(arguments.output, "FILE",
              "The closed surface, in the format of its name; - for standard output")
      .number("--voxel", options.voxel, "LENGTH", length,
              "How fine: between the points of the lattice, in units of the mesh")
      .preset("the longest side of the box / 128, at most half of --distance")
      .number("--resolution", options.resolution, "N", {1, 100'000},
              "How fine: voxels along the longest side of the box")
      .preset("128")
      .number("--distance", options.distance, "LENGTH", length,
              "Of the surface from the soup, a voxel at least")
      .preset("two voxels")
      .number("--gap", options.gap, "LENGTH", length,
              "Draw the surface in at last, until so much of the distance is left; it may cut into "
              "the soup then")
      .preset("all of it")
      .flag("--largest", options.largest,
            "Keep the largest of the parts that are apart, instead of joining all")
      .number("--faces", options.faces, "N", {0, 100'000'000},
              "Leave about so many triangles; it may cut into the soup and itself then")
      .preset("all")
      .json(arguments)
      .threads(arguments)
      .console(arguments);
}

}  // namespace

Command declare_wrap(CLI::App& program) {
  return make_command(program, "wrap", summary, declare_options, run_wrap);
}

}  // namespace sphparam::cli
