// `sphparam measure`: how far two surfaces are apart. The one command that takes any triangles,
// closed or not.

#include <algorithm>
#include <array>
#include <cmath>

#include "commands/command.h"
#include "commands/surfaces.h"
#include "console/places.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/up_axis.h"
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
    "  sphparam measure scan.ply part.stl --signed --per-vertex deviation.ply\n"
    "\n"
    "Both directions: samples spread evenly over each surface, and their nearest points on the\n"
    "other. Maxima (the larger is the Hausdorff distance) are over vertices too and then sought\n"
    "between the samples. Any meshes: they need not be closed. Lengths are in the unit of the\n"
    "meshes, % are of the diagonal of A's bounding box. The exit status is 6 where a limit is\n"
    "exceeded.\n";

struct MeasureArguments : CommonArguments {
  std::string first;
  std::string second;
  DistanceOptions options;
  std::string sampled = "faces";
  std::string per_vertex;
  RepairArguments repair;                       // of both
  std::optional<Amount> max_rms, max_distance;  // % of the diagonal of the first's bounding box
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
  check_places({{"--per-vertex", arguments.per_vertex}, {"--json", arguments.json}});
}

SurfaceDistance measure(const MeasureArguments& arguments, const MeshFile& first,
                        const MeshFile& second, Session& session) try {
  DistanceOptions options = arguments.options;
  options.threads = session.threads();
  options.progress = session.progress();
  return measure_distance(first.mesh, second.mesh, options);
} catch (const UnmeasurableSurface& error) {
  const bool first_is_it = error.side() == Side::First;
  const std::string name = display_name(first_is_it ? arguments.first : arguments.second);
  if ((first_is_it ? first : second).mesh.face_count() == 0) throw ReadError(name, error.what());
  throw UnmeasurableMesh(name + ": " + error.what());
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

/// Whether they are much nearer to one another as glTF has what stands as the other file says.
bool is_nearer_turned(const MeshFile& gltf, const MeshFile& other, double rms,
                      const MeasureArguments& arguments, Session& session) {
  constexpr double much = 0.5;
  constexpr std::int64_t enough = 10'000;
  TriangleMesh turned = other.mesh;
  turned.positions *= upright_rotation(upright_axes(other)).transpose();
  DistanceOptions options = arguments.options;
  options.samples = std::min(options.samples, enough);
  options.extremes = false;
  options.deviations = false;
  options.threads = session.threads();
  return measure_distance(gltf.mesh, turned, options).rms() <= much * rms;
}

/// y points up in glTF, so whatever writes it turns a mesh in which z does: apart for that alone.
/// A body that is nearly round is not far from itself as it is turned.
void tell_turned(const MeasureArguments& arguments, const MeshFile& first, const MeshFile& second,
                 const SurfaceDistance& distance, Session& session) {
  constexpr double far = 0.01, near = 1e-4;  // of the diagonal
  const auto is_gltf = [](const MeshFile& file) { return file.format.starts_with("glTF"); };
  if (is_gltf(first) == is_gltf(second)) return;
  const bool first_is_gltf = is_gltf(first);
  const MeshFile& not_gltf = first_is_gltf ? second : first;
  const std::optional<Vector3> up = noted_up(not_gltf).direction;
  if (up && *up == Vector3::UnitY()) return;
  const double apart = distance.rms() / distance.diagonal_first;
  if (apart < near) return;
  if (apart < far && !is_nearer_turned(first_is_gltf ? first : second, not_gltf, distance.rms(),
                                       arguments, session))
    return;
  const std::string a = display_name(arguments.first), b = display_name(arguments.second);
  const std::string& gltf = first_is_gltf ? a : b;
  const std::string& other = first_is_gltf ? b : a;
  const std::string& path = first_is_gltf ? arguments.second : arguments.first;
  const std::string typed = is_stream(path) ? "FILE" : shell_file(path);
  // A new name: what was measured stays what it is.
  const std::string output = (is_stream(path) ? "mesh" : stem_of(path)) + "_as_it_stands.glb";
  session.console.say("  y points up in " + gltf + ", which is glTF, and in " + other + " " +
                      (up ? name_of_direction(*up) + " does" : "nothing says what does") +
                      ": they may be turned; `sphparam export " + typed + " --up y -o " +
                      shell_file(output) + "` writes it as it stands");
}

/// A with each vertex's distance to B, and the side, where that is wanted.
MeshFile with_distances(const MeasureArguments& arguments, const MeshFile& first,
                        const OneSidedDistance& distance) {
  const VectorX& values = distance.at_vertices;
  const std::string about = "distance to " + display_name(arguments.second);
  if (!distance.deviation) return with_coloured_values(first, "error", values, about);
  MeshFile file = with_coloured_values(first, "deviation", distance.deviation->at_vertices,
                                       about + ", less than 0 inside");
  file.set_vertex_property(
      {"error", ScalarType::Float64, std::vector<double>(values.begin(), values.end())});
  return file;
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
  const MeshFile second = read_surface(arguments.second, arguments.repair, session);
  session.hold_signals();
  const SurfaceDistance distance = measure(arguments, first, second, session);
  tell_turned(arguments, first, second, distance, session);
  DistanceRecord record = {.first = arguments.first,
                           .second = arguments.second,
                           .first_file = first,
                           .second_file = second,
                           .options = arguments.options,
                           .distance = distance,
                           .limits = judge(arguments, distance)};
  if (!arguments.per_vertex.empty()) {
    session.files.add(
        arguments.per_vertex,
        serialise_mesh(arguments.per_vertex, with_distances(arguments, first, distance.forth)));
    record.outputs.emplace_back("per_vertex", arguments.per_vertex);
  }
  record.seconds = session.stopwatch.seconds();
  session.add_report([&] { return to_json(record); });
  const bool data_goes_out = is_stream(arguments.json) || is_stream(arguments.per_vertex);
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
      .flag("--signed", options.deviations,
            "Also on which side of B, a closed surface, A is: distances less than 0 inside; in "
            "--per-vertex as property deviation, and the colours")
      .json(arguments);
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
