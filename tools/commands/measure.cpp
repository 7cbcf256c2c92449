// `sphparam measure`: how far two surfaces are apart. The one command that takes any triangles,
// closed or not.

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "arguments/choice.h"
#include "arguments/common_options.h"
#include "arguments/input_limits.h"
#include "commands/command.h"
#include "console/console.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/paths.h"
#include "sphparam/errors.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/records/distance_record.h"
#include "sphparam/render/coloured_values.h"
#include "sphparam/stopwatch.h"
#include "number_text.h"

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
    "\n"
    "Both directions: samples spread evenly over each surface, and their nearest points on the\n"
    "other. Maxima (the larger is the Hausdorff distance) are over vertices too and then sought\n"
    "between the samples. Any meshes: they need not be closed. Lengths are in the unit of the\n"
    "meshes, % are of the diagonal of A's bounding box. The exit status is 6 where a limit is\n"
    "exceeded.\n";

/// A length as the user gives it: in the unit of the mesh, or in % of the diagonal of the first
/// mesh's bounding box.
struct LengthLimit {
  double value = 0;
  bool of_diagonal = false;  // in %

  double length(double diagonal) const { return of_diagonal ? value / 100 * diagonal : value; }
};

struct MeasureArguments {
  std::string first;
  std::string second;
  DistanceOptions options;
  std::string sampled = "faces";
  std::string per_vertex;
  std::string json;
  std::optional<LengthLimit> max_rms;
  std::optional<LengthLimit> max_distance;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
};

/// "0.01" or "0.5%".
std::optional<LengthLimit> parse_length(std::string text) {
  LengthLimit limit;
  limit.of_diagonal = !text.empty() && text.back() == '%';
  if (limit.of_diagonal) text.pop_back();
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, limit.value);
  const bool number = error == std::errc{} && stop == end && std::isfinite(limit.value);
  return number && limit.value >= 0 ? std::optional(limit) : std::nullopt;
}

void settle_sampled(const std::string& text, DistanceOptions& options) {
  const std::vector<std::string> words = {"faces", "edges", "vertices"};
  options.faces = options.edges = options.vertices = false;
  if (text.empty()) throw UsageMistake("--over: expected faces, edges or vertices");
  for (const std::string& word : CLI::detail::split(text, ',')) {
    if (word == words[0]) {
      options.faces = true;
    } else if (word == words[1]) {
      options.edges = true;
    } else if (word == words[2]) {
      options.vertices = true;
    } else {
      const std::string meant = nearest_word(word, words);
      throw UsageMistake("--over: no " + word + " among faces, edges, vertices" +
                         (meant.empty() ? "" : "; did you mean " + meant + "?"));
    }
  }
}

void require_sensible(const MeasureArguments& arguments) {
  if (is_stream(arguments.first) && is_stream(arguments.second)) {
    throw UsageMistake("the two meshes cannot both come from standard input");
  }
  const std::string extension = extension_of(arguments.per_vertex);
  if (!extension.empty() && extension != ".ply") {
    throw UsageMistake("--per-vertex: the mesh is a PLY, the name must end in .ply, not " +
                       extension);
  }
  check_places({arguments.first, arguments.second},
               {{"--per-vertex", arguments.per_vertex}, {"--json", arguments.json}});
}

SurfaceDistance measure(const MeasureArguments& arguments, const MeshFile& first,
                        const MeshFile& second, Console& console) {
  DistanceOptions options = arguments.options;
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
  try {
    const SurfaceDistance distance = measure_distance(first.mesh, second.mesh, options);
    console.clear_progress();
    return distance;
  } catch (const UnmeasurableSurface& error) {
    const bool first_is_it = error.side() == Side::First;
    const std::string name = display_name(first_is_it ? arguments.first : arguments.second);
    if ((first_is_it ? first : second).mesh.face_count() == 0) throw ReadError(name, error.what());
    throw UnmeasurableMesh(name + ": " + error.what());
  }
}

/// The first mesh with the distance of each vertex, as the property `error` and as colours from 0
/// to the largest.
MeshFile with_errors(const MeshFile& file, const OneSidedDistance& side, const std::string& other) {
  MeshFile coloured = with_coloured_values(file, "error", side.at_vertices);
  const double largest = side.at_vertices.size() > 0 ? side.at_vertices.maxCoeff() : 0;
  coloured.comments.push_back("error: distance to " + one_line(other) + ", colours from 0 to " +
                              short_number(largest, 6));
  return coloured;
}

std::vector<DistanceLimit> judge(const MeasureArguments& arguments,
                                 const SurfaceDistance& distance) {
  std::vector<DistanceLimit> limits;
  const auto judge_one = [&](const char* option, const std::optional<LengthLimit>& limit,
                             double measured) {
    if (limit) limits.push_back({option, limit->length(distance.diagonal_first), measured});
  };
  judge_one("--max-rms", arguments.max_rms, distance.rms());
  judge_one("--max-distance", arguments.max_distance, distance.max());
  return limits;
}

int run_measure(MeasureArguments arguments) {
  const Stopwatch stopwatch;
  settle_sampled(arguments.sampled, arguments.options);
  require_sensible(arguments);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const MeshFile first = read_mesh(arguments.first, input_limits());
  const MeshFile second = read_mesh(arguments.second, input_limits());
  for (const MeshFile* file : {&first, &second}) {
    for (const std::string& note : file->notes) console.detail(note);
  }
  const OrderlyInterruption orderly;
  const SurfaceDistance distance = measure(arguments, first, second, console);
  DistanceRecord record = {.first = arguments.first,
                           .second = arguments.second,
                           .first_file = first,
                           .second_file = second,
                           .options = arguments.options,
                           .distance = distance,
                           .limits = judge(arguments, distance)};
  PendingFiles files;
  if (!arguments.per_vertex.empty()) {
    files.add(arguments.per_vertex,
              serialise_mesh(arguments.per_vertex,
                             with_errors(first, distance.forth, display_name(arguments.second))));
    record.outputs.emplace_back("per_vertex", arguments.per_vertex);
  }
  record.seconds = stopwatch.seconds();
  if (!arguments.json.empty()) files.add(arguments.json, to_json(record));
  const bool data_goes_out = is_stream(arguments.json) || is_stream(arguments.per_vertex);
  if (!arguments.loudness.quiet && !data_goes_out) files.add("-", to_text(record));
  if (interrupted()) throw Cancelled();
  files.publish();
  bool exceeded = false;
  for (const DistanceLimit& limit : record.limits) {
    if (!limit.exceeded()) continue;
    exceeded = true;
    print_error("measured " + short_number(limit.measured, 6) + ", more than " + limit.name + " " +
                short_number(limit.limit, 6));
  }
  return exceeded ? LimitExceeded : Ok;
}

void add_length(CLI::App& command, const std::string& name, std::optional<LengthLimit>& limit,
                const std::string& description) {
  command
      .add_option_function<std::string>(
          name,
          [&limit, name](const std::string& text) {
            limit = parse_length(text);
            if (!limit) throw CLI::ValidationError(name, "expected a length, as 0.01 or 0.5%");
          },
          description)
      ->type_name("X|X%");
}

void add_sampling(CLI::App& command, MeasureArguments& arguments) {
  command.add_option("--samples", arguments.options.samples, "Samples of each surface")
      ->check(between<std::int64_t>(1, 100'000'000'000, "1 to 100000000000"))
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--seed", arguments.options.seed, "Of the samples' places")
      ->check(between<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max(), "0 on"))
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option("--over", arguments.sampled,
                  "What mean and RMS are over: faces, edges, vertices, with commas between; "
                  "MeshLab's filter takes all three")
      ->type_name("WHAT")
      ->capture_default_str();
}

}  // namespace

Command declare_measure(CLI::App& program) {
  const auto arguments = std::make_shared<MeasureArguments>();
  CLI::App* command = program.add_subcommand("measure", summary);
  command->add_option("A", arguments->first, "A mesh; - for standard input")
      ->type_name(" ")
      ->required();
  command->add_option("B", arguments->second, "Another; - for standard input")
      ->type_name(" ")
      ->required();
  add_sampling(*command, *arguments);
  command
      ->add_option("--per-vertex", arguments->per_vertex,
                   "A with each vertex's distance to B: property error, and colours")
      ->type_name("FILE");
  add_json(*command, arguments->json);
  add_length(*command, "--max-rms", arguments->max_rms,
             "Exit with status 6 if the larger RMS is more; % of A's diagonal");
  add_length(*command, "--max-distance", arguments->max_distance,
             "Exit with status 6 if the larger maximum is more; % likewise");
  add_threads(*command, arguments->options.threads);
  add_progress(*command, arguments->progress);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments] { return run_measure(*arguments); }};
}

}  // namespace sphparam::cli
