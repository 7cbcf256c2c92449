// `sphparam measure`: how far two surfaces are apart. The one command that takes any triangles,
// closed or not.

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "arguments/ends.h"
#include "arguments/mesh_names.h"
#include "commands/command.h"
#include "commands/surfaces.h"
#include "console/places.h"
#include "elementary.h"
#include "io/attributes/other_coordinates.h"
#include "io/data_comments.h"
#include "measure/enclosure.h"
#include "mesh/box.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/measure/alignment.h"
#include "sphparam/measure/coordinates_apart.h"
#include "sphparam/mesh/mass_properties.h"
#include "sphparam/records/distance_record.h"
#include "sphparam/render/coloured_values.h"

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Say how far two surfaces are from one another.\n"
    "\n"
    "Examples:\n"
    "  sphparam measure statue.obj statue_low.ply\n"
    "  sphparam measure statue.obj statue_low.ply --samples 10000000 --json distance.json\n"
    "  sphparam measure statue.obj statue_low.ply --max-rms 0.1% || echo too far\n"
    "  sphparam measure statue.obj statue_low.ply --per-vertex error.ply\n"
    "  sphparam measure scan.ply part.stl --signed --per-vertex deviation.ply --range -0.1,0.1\n"
    "  sphparam measure scan.ply part.stl --within 0.1\n"
    "  sphparam measure part.stl scan.ply --align rigid\n"
    "  sphparam measure part.stl scan.ply --align rigid --leave-out-border --aligned onto.ply\n"
    "  sphparam measure visit1.sph.ply visit2.sph.ply --growth --per-vertex growth.ply\n"
    "\n"
    "Both directions: samples spread evenly over each surface, and their nearest points on the\n"
    "other. Maxima (the larger is the Hausdorff distance) are over vertices too and then sought\n"
    "between the samples. Any meshes: they need not be closed. Lengths are in the unit of the\n"
    "meshes, % are of the diagonal of A's bounding box. The exit status is 6 where a limit is\n"
    "exceeded.\n";

enum class Align { None, Rigid, Similarity };

struct MeasureArguments : CommonArguments {
  std::string first;
  std::string second;
  DistanceOptions options;
  std::string sampled = "faces";
  std::string per_vertex;
  std::string aligned;                                  // the second as it was put onto the first
  RepairArguments repair;                               // of both
  bool upright = false;                                 // as their files say what is up
  Align align = Align::None;                            // the second onto the first, before
  bool growth = false;                                  // of areas: both have the same triangles
  std::optional<std::pair<double, double>> range;       // of the colours
  std::optional<Amount> max_rms, max_distance, within;  // % of the diagonal of the first's box
};

void settle_sampled(const std::string& text, DistanceOptions& options) {
  if (text.empty()) throw UsageMistake("--over: expected faces, edges or vertices");
  const Words words = {"faces", "edges", "vertices"};
  const std::array<bool*, 3> switches = {&options.faces, &options.edges, &options.vertices};
  for (bool* one : switches) *one = false;
  for (const std::string& word : split(text)) *switches[place_among(words, word, "--over")] = true;
}

void require_sensible(const MeasureArguments& arguments) {
  require_one_stream({arguments.first, arguments.second}, "the two meshes");
  const std::string extension = inner_extension_of(arguments.per_vertex);
  if (!extension.empty() && !keeps_map(arguments.per_vertex)) {
    throw UsageMistake(
        "--per-vertex: distances have a place in .ply, .vtk and .vtp; the name must end so, not "
        "in " +
        extension);
  }
  if (arguments.range && arguments.per_vertex.empty())
    throw UsageMistake("--range is of the colours of --per-vertex: name a file for these");
  if (arguments.range && arguments.growth)
    throw UsageMistake("--range is of the colours of distances: with --growth they are of areas");
  require_mesh_name("--aligned", "B on A", arguments.aligned);
  check_places({{"--per-vertex", arguments.per_vertex},
                {"--aligned", arguments.aligned},
                {"--json", arguments.json}});
  if (!arguments.aligned.empty() && arguments.align == Align::None)
    throw UsageMistake("--aligned is of B as --align puts it onto A: give that as well");
}

/// What closes the second, where that is what is wrong; else empty.
std::string way_on(const MeasureArguments& arguments, const MeshFile& second, Side side) {
  const bool is_open = side == Side::Second && arguments.options.deviations &&
                       second.mesh.face_count() > 0 && unclosed_edges(second.mesh.triangles) > 0;
  if (!is_open) return "";
  return "; close it alone first, as `sphparam repair B -o closed.ply` does with holes, or "
         "`sphparam wrap` with anything else, and give closed.ply as B (--repair mends A as well)";
}

[[noreturn]] void refuse(const UnmeasurableSurface& error, const MeasureArguments& arguments,
                         const MeshFile& first, const MeshFile& second) {
  const bool first_is_it = error.side() == Side::First;
  const std::string name = display_name(first_is_it ? arguments.first : arguments.second);
  if ((first_is_it ? first : second).mesh.face_count() == 0) throw ReadError(name, error.what());
  throw UnmeasurableMesh(name + ": " + error.what() + way_on(arguments, second, error.side()));
}

/// `enclosing`: the second with its fillers, where it has some: they tell what is inside.
SurfaceDistance measure(const MeasureArguments& arguments, const MeshFile& first,
                        const MeshFile& second, const std::optional<TriangleMesh>& enclosing,
                        Session& session) try {
  DistanceOptions options = arguments.options;
  if (enclosing && unclosed_edges(enclosing->triangles) == 0) options.enclosing = &*enclosing;
  options.threads = session.threads();
  options.progress = session.progress();
  return measure_distance(first.mesh, second.mesh, options);
} catch (const UnmeasurableSurface& error) {
  refuse(error, arguments, first, second);
}

/// Puts the second onto the first, where that is wanted.
std::optional<Alignment> align(const MeasureArguments& arguments, const MeshFile& first,
                               MeshFile& second, Session& session) try {
  if (arguments.align == Align::None) return std::nullopt;
  const Alignment alignment = align_surfaces(first.mesh, second.mesh,
                                             {.scale = arguments.align == Align::Similarity,
                                              .seed = arguments.options.seed,
                                              .threads = session.threads(),
                                              .progress = session.progress()});
  second.mesh.positions = moved(std::move(second.mesh.positions), alignment.motion);
  return alignment;
} catch (const UnmeasurableSurface& error) {
  refuse(error, arguments, first, second);
}

std::vector<DistanceLimit> judge(const MeasureArguments& arguments,
                                 const SurfaceDistance& distance) {
  std::vector<DistanceLimit> limits;
  const auto judge_one = [&](const char* option, const std::optional<Amount>& limit,
                             double measured) {
    if (limit) limits.push_back({option, limit->of(distance.diagonal_first), measured});
  };
  judge_one("--max-rms", arguments.max_rms, distance.rms());
  judge_one("--max-distance", arguments.max_distance, distance.max());
  return limits;
}

/// One body in two units?
void tell_units(const MeasureArguments& arguments, const MeshFile& first, const MeshFile& second,
                Session& session) {
  const std::optional<UnitsApart> apart = units_apart(first.mesh, second.mesh);
  if (!apart) return;
  const bool first_is_smaller = apart->smaller == Side::First;
  session.warn({display_name(first_is_smaller ? arguments.first : arguments.second) + " is " +
                short_number(apart->ratio, 4) + " times smaller than " +
                display_name(first_is_smaller ? arguments.second : arguments.first) +
                ", and of the same proportions: are both in one unit, not in " + apart->units +
                "?"});
}

/// One body in two systems of coordinates? Nobody asks how far what is elsewhere is.
void tell_far_apart(const MeasureArguments& arguments, const MeshFile& first,
                    const MeshFile& second, Session& session) {
  const double apart = far_apart(first.mesh, second.mesh);
  if (apart == 0) return;
  session.warn({display_name(arguments.first) + " and " + display_name(arguments.second) + " are " +
                short_number(apart, 4) +
                " from one another, farther than either is large: "
                "has one been moved, as a global shift of coordinates does? --align rigid first "
                "puts B onto A"});
}

Eigen::Matrix3d stance(const MeshFile& file) { return upright_rotation(upright_axes(file)); }

/// How it is turned so that it stands in the other's coordinates as it says it does in its own.
Eigen::Matrix3d turn_as(const MeshFile& other, const MeshFile& file) {
  return stance(file).transpose() * stance(other);
}

TriangleMesh turned_as(const MeshFile& other, const MeshFile& file) {
  TriangleMesh mesh = file.mesh;
  mesh.positions *= turn_as(other, file);
  return mesh;
}

/// Whether they are much nearer to one another as they stand.
bool is_nearer_turned(const MeshFile& first, const MeshFile& second, double rms,
                      const MeasureArguments& arguments, Session& session) {
  constexpr double much = 0.5;
  constexpr std::int64_t enough = 10'000;
  DistanceOptions options = arguments.options;
  options.samples = std::min(options.samples, enough);
  options.extremes = false;
  options.deviations = false;
  options.leave_out_borders = false;
  options.threads = session.threads();
  return measure_distance(first.mesh, turned_as(first, second), options).rms() <= much * rms;
}

bool is_gltf(const MeshFile& file) { return file.format.starts_with("glTF"); }

/// y points up in glTF, so whatever writes it turns a mesh in which z does. What says nothing may
/// stand in any way, but most has z up.
bool say_otherwise(const MeshFile& first, const MeshFile& second) {
  const auto says = [](const MeshFile& file) { return noted_up(file).direction.has_value(); };
  const bool is_said = (says(first) && says(second)) || is_gltf(first) || is_gltf(second);
  return is_said && stance(first) != stance(second);
}

/// How the first of two stands, and the second otherwise: "y points up in a.glb, which is glTF, and
/// in b.ply z does".
std::string words_of_stances(const std::string& name, const MeshFile& file,
                             const std::string& other_name, const MeshFile& other) {
  const UprightAxes one = upright_axes(file), two = upright_axes(other);
  const bool by_front = one.up == two.up;
  const Up said = noted_up(other);
  const bool is_said = (by_front ? said.front : said.direction) || is_gltf(other);
  return name_of_direction(by_front ? one.front : one.up) +
         (by_front ? " looks at who sees " : " points up in ") + name +
         (is_gltf(file) ? ", which is glTF, and in " : ", and in ") + other_name + " " +
         (is_said ? name_of_direction(by_front ? two.front : two.up) + " does"
                  : "nothing says what does");
}

/// Apart for how they stand alone? A body that is nearly round is not far from itself as it is
/// turned.
void tell_turned(const MeasureArguments& arguments, const MeshFile& first, const MeshFile& second,
                 const SurfaceDistance& distance, Session& session) {
  constexpr double far = 0.01, near = 1e-4;  // of the diagonal
  if (!say_otherwise(first, second)) return;
  const double apart = distance.rms() / distance.diagonal_first;
  if (apart < near) return;
  if (apart < far && !is_nearer_turned(first, second, distance.rms(), arguments, session)) return;
  const std::string a = display_name(arguments.first), b = display_name(arguments.second);
  const bool in_order = is_gltf(first) || !is_gltf(second);
  session.console.say(
      "  " +
      (in_order ? words_of_stances(a, first, b, second) : words_of_stances(b, second, a, first)) +
      ": they may be turned; --upright measures them as they stand");
}

/// The second as it stands beside the first, where that is wanted, which is told.
MeshFile placed(const MeasureArguments& arguments, const MeshFile& first, MeshFile second,
                Session& session) {
  if (!arguments.upright || stance(first) == stance(second)) return second;
  second.mesh = turned_as(first, second);
  const UprightAxes axes = upright_axes(second), seen = upright_axes(first);
  session.console.say("  " + display_name(arguments.second) + " is turned as " +
                      display_name(arguments.first) + " stands: " + name_of_direction(axes.up) +
                      ", which is up, to " + name_of_direction(seen.up) + ", and " +
                      name_of_direction(axes.front) + ", the front, to " +
                      name_of_direction(seen.front));
  return second;
}

std::optional<Growth> growth_asked_for(const MeasureArguments& arguments, const MeshFile& first,
                                       const MeshFile& second) try {
  if (!arguments.growth) return std::nullopt;
  return measure_growth(first.mesh, second.mesh);
} catch (const std::invalid_argument&) {
  throw UsageMistake("--growth: " + display_name(arguments.second) + " has not the triangles of " +
                     display_name(arguments.first) +
                     ", one by one; of two maps `sphparam match` or `group` makes surfaces that "
                     "have, of two on one sphere `remesh`");
}

/// The colours are of something else.
void forget_colours(std::vector<std::string>& comments) {
  for (std::string& comment : comments)
    if (comment.starts_with("error: ") || comment.starts_with("deviation: "))
      comment.resize(std::min(comment.size(), comment.rfind(", colours from ")));
}

/// The areas of B over those of A, at vertices and faces, in colours of their logarithms.
MeshFile with_growth(MeshFile file, const Growth& growth, const std::string& second) {
  const VectorX logarithms =
      growth.vertices.unaryExpr([](double x) { return x > 0 ? elementary::log(x) : 0.0; });
  forget_colours(file.comments);
  file = with_coloured_values(std::move(file), "growth", logarithms,
                              "area in " + display_name(second) +
                                  " over that here; of its "
                                  "natural logarithm");
  const auto property = [](const VectorX& values) {
    return Property{"growth", ScalarType::Float64,
                    std::vector<double>(values.begin(), values.end())};
  };
  file.set_vertex_property(property(growth.vertices));
  file.set_face_property(property(growth.faces));
  return file;
}

using Renamed = std::vector<std::pair<std::string, std::string>>;

/// "error_a" of "error", as `match` calls what A has beside what is new.
std::string free_name(const MeshFile& file, std::string name) {
  do name += "_a";
  while (file.find_vertex_property(name) || file.find_face_property(name));
  return name;
}

/// Numbers of its own that are called as those to come get another name. Returns old and new.
Renamed make_way(MeshFile& file, const MeasureArguments& arguments) {
  Words taken = {"error", "red", "green", "blue", "alpha"};
  if (arguments.options.leave_out_borders) taken.push_back("left_out");
  if (arguments.options.deviations) taken.push_back("deviation");
  if (arguments.growth) taken.push_back("growth");
  Renamed renamed;
  for (const std::string& name : taken) {
    if (!file.find_vertex_property(name)) continue;
    renamed.emplace_back(name, free_name(file, name));
    rename_vertex_property(file, name, renamed.back().second);
  }
  for (Property& property : file.face_properties) {
    if (!arguments.growth || property.name != "growth") continue;
    renamed.emplace_back("growth of faces", free_name(file, property.name));
    property.name = renamed.back().second;
  }
  return renamed;
}

void tell_renamed(const MeasureArguments& arguments, const Renamed& renamed, Session& session) {
  if (renamed.empty()) return;
  std::vector<std::string> words;
  for (const auto& [old, name] : renamed) words.push_back(old + " is " + name);
  session.console.say("  numbers that " + display_name(arguments.first) +
                      " has already are called otherwise in " + output_name(arguments.per_vertex) +
                      ": " + joined(words));
}

/// Marks what was left out, in grey.
MeshFile with_left_out(MeshFile file, const std::vector<std::uint8_t>& left_out) {
  constexpr double grey = 128;
  for (Property& property : file.vertex_properties) {
    if (property.name != "red" && property.name != "green" && property.name != "blue") continue;
    for (std::size_t v = 0; v < left_out.size(); ++v)
      if (left_out[v]) property.values[v] = grey;
  }
  file.set_vertex_property(
      {"left_out", ScalarType::Uint8, std::vector<double>(left_out.begin(), left_out.end())});
  return file;
}

/// What was left out has no part in the scale of the colours.
VectorX without_left_out(VectorX values, const std::vector<std::uint8_t>& left_out) {
  for (std::size_t v = 0; v < left_out.size(); ++v)
    if (left_out[v]) values[static_cast<Eigen::Index>(v)] = 0;
  return values;
}

/// A with each vertex's distance to B, and the side, where that is wanted.
MeshFile with_distances(const MeasureArguments& arguments, MeshFile file,
                        const OneSidedDistance& distance) {
  const VectorX& values = distance.at_vertices;
  const auto& left_out = distance.left_out_vertices;
  const std::string about =
      "distance to " + display_name(arguments.second) +
      (left_out.empty() ? "" : ", grey where nearest to its border and left out");
  const auto set = [&](const char* name, const VectorX& all) {
    file.set_vertex_property(
        {name, ScalarType::Float64, std::vector<double>(all.begin(), all.end())});
  };
  if (const auto& deviation = distance.deviation) {
    file = with_coloured_values(
        std::move(file), "deviation", without_left_out(deviation->at_vertices, left_out),
        about + ", less than 0 inside", {.diverges = true, .range = arguments.range});
    set("deviation", deviation->at_vertices);
  } else {
    file = with_coloured_values(std::move(file), "error", without_left_out(values, left_out), about,
                                {.range = arguments.range});
  }
  set("error", values);
  return left_out.empty() ? file : with_left_out(std::move(file), left_out);
}

const std::vector<std::string> normal_names = {"nx", "ny", "nz"};

bool has_normals(const MeshFile& file) {
  return file.corner_normals || file.find_vertex_property("nx") || file.find_face_property("nx");
}

/// The second in the first's coordinates: what points up there is what does in the first. Its
/// normals were of its own.
void write_aligned(const MeasureArguments& arguments, const MeshFile& first, MeshFile second,
                   Session& session) {
  if (has_normals(second))
    session.console.say("  normals of " + display_name(arguments.second) + " are left out of " +
                        output_name(arguments.aligned) + ": they are of where it was");
  Points positions = std::move(second.mesh.positions);
  move_into(second, first, std::move(positions));
  remove_properties(second.face_properties, normal_names);
  tell_losses(arguments.aligned, add_mesh(session.files, arguments.aligned, std::move(second)),
              session.console);
}

/// What it encloses, where it is closed.
std::optional<double> volume_of(const MeshFile& file) {
  if (unclosed_edges(file.mesh.triangles) > 0) return std::nullopt;
  const std::optional<MassProperties> body = mass_properties(file.mesh);
  return body ? std::optional(std::abs(body->volume)) : std::nullopt;
}

/// The exit code.
int tell_exceeded(const std::vector<DistanceLimit>& limits) {
  int code = Ok;
  for (const DistanceLimit& limit : limits) {
    if (!limit.exceeded()) continue;
    code = LimitExceeded;
    std::string measured = short_number(limit.measured, 6), most = short_number(limit.limit, 6);
    if (measured == most) measured = shortest(limit.measured), most = shortest(limit.limit);
    print_error("measured " + measured + ", more than " + limit.name + " " + most);
  }
  return code;
}

int run_measure(MeasureArguments& arguments) {
  Session session(arguments);
  settle_sampled(arguments.sampled, arguments.options);
  require_sensible(arguments);
  const MeshFile first = read_surface(arguments.first, arguments.repair, session);
  std::optional<TriangleMesh> with_fillers;
  MeshFile second = read_surface(arguments.second, arguments.repair, session, &with_fillers);
  if (with_fillers && arguments.upright) with_fillers->positions *= turn_as(first, second);
  second = placed(arguments, first, std::move(second), session);
  session.hold_signals();
  if (arguments.align != Align::Similarity) tell_units(arguments, first, second, session);
  if (arguments.align == Align::None) tell_far_apart(arguments, first, second, session);
  const std::optional<Alignment> alignment = align(arguments, first, second, session);
  if (with_fillers && alignment)
    with_fillers->positions = moved(std::move(with_fillers->positions), alignment->motion);
  if (arguments.within)
    arguments.options.within = arguments.within->of(
        Vector3(surface_box(first.mesh).upper - surface_box(first.mesh).lower).norm());
  const std::optional<Growth> growth = growth_asked_for(arguments, first, second);
  const SurfaceDistance distance = measure(arguments, first, second, with_fillers, session);
  if (!arguments.upright && !alignment) tell_turned(arguments, first, second, distance, session);
  DistanceRecord record = {.first = arguments.first,
                           .second = arguments.second,
                           .first_file = first,
                           .second_file = second,
                           .options = arguments.options,
                           .distance = distance,
                           .upright = arguments.upright,
                           .alignment = alignment,
                           .growth = growth,
                           .first_volume = volume_of(first),
                           .second_volume = volume_of(second),
                           .limits = judge(arguments, distance)};
  if (!arguments.per_vertex.empty()) {
    MeshFile file = first;
    record.renamed = make_way(file, arguments);
    tell_renamed(arguments, record.renamed, session);
    file = with_distances(arguments, std::move(file), distance.forth);
    if (growth) file = with_growth(std::move(file), *growth, arguments.second);
    session.files.add(arguments.per_vertex, serialise_mesh(arguments.per_vertex, file));
    record.outputs.emplace_back("per_vertex", arguments.per_vertex);
  }
  if (!arguments.aligned.empty()) {
    write_aligned(arguments, first, second, session);
    record.outputs.emplace_back("aligned", arguments.aligned);
  }
  record.seconds = session.stopwatch.seconds();
  session.add_report([&] { return to_json(record); });
  const bool data_goes_out =
      is_stream(arguments.json) || is_stream(arguments.per_vertex) || is_stream(arguments.aligned);
  if (!arguments.quiet && !data_goes_out) session.files.add("-", to_text(record));
  session.publish();
  return tell_exceeded(record.limits);
}

void declare_length(Declaration& command, const std::string& name, std::optional<Amount>& limit,
                    const std::string& about) {
  const auto read = [&limit](const std::string& text) {
    limit = amount_of(text);
    return limit && std::isfinite(limit->value) && limit->value >= 0;
  };
  command.parsed(name, "X|X%", read, "expected a length, as 0.01 or 0.5%", about);
}

void declare_options(Declaration& command, MeasureArguments& arguments) {
  DistanceOptions& options = arguments.options;
  command.input("A", arguments.first, "A mesh; - for standard input")
      .input("B", arguments.second, "Another; - for standard input")
      .number("--samples", options.samples, "N", {1, 100'000'000'000}, "Samples of each surface")
      .number("--seed", options.seed, "N", {0}, "Of the samples' places")
      .text("--over", arguments.sampled, "WHAT",
            "What mean and RMS are over: faces, edges, vertices, with commas between; MeshLab's "
            "filter takes all three")
      .text("--per-vertex", arguments.per_vertex, "FILE",
            "A with each vertex's distance to B: property error, and colours")
      .written()
      .parsed(
          "--range", "MIN,MAX",
          [&arguments](const std::string& text) {
            arguments.range = two_ends(text);
            return arguments.range.has_value();
          },
          wanted_ends,
          "Scale of the colours of --per-vertex, from blue by white to red where it is as far both "
          "ways, as -0.1,0.1; default: to the largest")
      .flag("--signed", options.deviations,
            "Also on which side of B, a closed surface, A is: distances less than 0 inside; in "
            "--per-vertex as property deviation, and the colours")
      .flag("--growth", arguments.growth,
            "Also how areas grow from A to B, which has A's triangles: B's over A's; in "
            "--per-vertex as property growth of vertices and faces, and the colours")
      .flag("--upright", arguments.upright,
            "B turned as A stands, by what their files say is up and in front: y and z in glTF; z "
            "and -y where nothing says")
      .choice(
          "--align", arguments.align,
          {{"none", Align::None}, {"rigid", Align::Rigid}, {"similarity", Align::Similarity}},
          "First put B onto A, turned and moved until samples of both are as near as they come, "
          "leaving out what one of them lacks; similarity: also scaled")
      .text("--aligned", arguments.aligned, "FILE", "B as --align puts it onto A")
      .written()
      .flag("--leave-out-border", options.leave_out_borders,
            "Leave out points whose nearest point lies on the border of the other mesh, as those "
            "over holes of a scan and beyond its end do; their share is told")
      .json(arguments);
  declare_length(command, "--within", arguments.within,
                 "Also which share of each surface is no farther than this from the other; % of "
                 "A's diagonal");
  declare_length(command, "--max-rms", arguments.max_rms,
                 "Exit with status 6 if the larger RMS is more; % of A's diagonal");
  declare_length(command, "--max-distance", arguments.max_distance,
                 "Exit with status 6 if the larger maximum is more; % likewise");
  declare_repair_options(command, arguments.repair);
  command.threads(arguments).console(arguments);
}

}  // namespace

Command declare_measure(CLI::App& program) {
  return make_command(program, "measure", summary, declare_options, run_measure);
}

}  // namespace sphparam::cli
