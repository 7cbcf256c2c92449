// `sphparam map`: file → mesh → map → proof → file. The map waits under a temporary name until what
// was read back from the disk is certified and everything else is written; then it is renamed.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/interruption.h"
#include "cli/json_report.h"
#include "cli/map_arguments.h"
#include "cli/paths.h"
#include "cli/source.h"
#include "cli/stopwatch.h"
#include "cli/wording.h"
#include "mesh_io/mesh_reader.h"
#include "mesh_io/mesh_writer.h"
#include "mesh_io/safe_file.h"
#include "mesh_io/sphere_file.h"
#include "report/charts.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/parameterize.h"
#include "sphparam/version.h"

namespace sphparam::tools {

namespace {

/// What we wrote may be larger than what strangers may send.
constexpr ReadOptions own_file = {.max_file_bytes = std::numeric_limits<std::uint64_t>::max(),
                                  .max_line_bytes = std::numeric_limits<std::int64_t>::max(),
                                  .max_ply_properties = std::numeric_limits<std::int64_t>::max()};

/// What one run found; once the map was written, `certificate` is of what was read back.
struct Outcome {
  Source source;
  Parameterization result = {};
  Certificate certificate = {};
  std::optional<Distortion> distortion = std::nullopt;
  std::optional<DistortionSummary> figures = std::nullopt;

  /// The paper's method makes none where no pair of poles is usable.
  bool has_map() const { return result.map.points.rows() > 0; }
  std::string verdict() const { return has_map() ? tools::verdict(certificate) : "no map"; }
};

/// A vertex of the file, by its number there, as a vertex of the mesh: welding and dropping unused
/// vertices may have renumbered them.
Vertex vertex_in_mesh(const MeshFile& file, Vertex named) {
  const Property* numbers = file.find_vertex_property("source_vertex");
  Vertex found = named;
  if (numbers) {
    const auto at = std::find(numbers->values.begin(), numbers->values.end(), named);
    found = static_cast<Vertex>(at - numbers->values.begin());
  }
  if (found < file.mesh.vertex_count()) return found;
  throw UsageMistake("--poles: the mesh has no vertex " + std::to_string(named) +
                     (numbers ? " (it was merged with another, or no face used it)"
                              : "; they are 0 to " + std::to_string(file.mesh.vertex_count() - 1)));
}

Outcome compute(Source source, const MapArguments& arguments, Console& console) {
  Outcome outcome = {.source = std::move(source)};
  if (!outcome.source.inspection.is_sphere()) throw MeshError(outcome.source.inspection.defects);
  const TriangleMesh& mesh = outcome.source.file.mesh;
  ParameterizeOptions options = arguments.options;
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
  if (options.poles) {
    options.poles = Poles{vertex_in_mesh(outcome.source.file, options.poles->north),
                          vertex_in_mesh(outcome.source.file, options.poles->south)};
  }
  outcome.result = parameterize(mesh, options);
  outcome.certificate = outcome.result.certificate;
  if (outcome.has_map()) {
    outcome.distortion = measure_distortion(mesh, outcome.result.map, options.threads);
    outcome.figures = summarise(*outcome.distortion);
  }
  return outcome;
}

std::string words(const std::optional<Poles>& poles) {
  return poles ? std::to_string(poles->north) + " " + std::to_string(poles->south) : "none";
}

Provenance provenance(const MapArguments& arguments, const Outcome& outcome) {
  return {{"version", version},
          {"method", name_of(arguments.options.method)},
          {"stage", outcome.result.made_by},
          {"options", options_line(arguments.options)},
          {"poles", words(outcome.result.poles)},
          {"verdict", outcome.verdict()}};
}

/// Throws NotCertifiedError unless the bytes of a written map hold what was found in memory.
void require_same_verdict(const std::string& path, const MeshFile& file, const SphereMap& map,
                          const Outcome& outcome, int threads) {
  const Certificate on_disk = certify(Topology(file.mesh), map, threads);
  if (verdict(on_disk) != outcome.verdict()) {
    throw NotCertifiedError(path + ": as written, the map is " + verdict(on_disk));
  }
}

void write_sphere(const MapArguments& arguments, const Outcome& outcome) {
  const std::string& path = arguments.sphere;
  const MeshFile sphere =
      sphere_mesh(outcome.source.file, outcome.result.map, provenance(arguments, outcome));
  const std::string bytes = serialiser(path)(sphere);
  write_file(path, bytes, [&](std::string_view written) {
    const MeshFile file = read_mesh(written, path, own_file);
    require_same_verdict(path, file, {file.mesh.positions}, outcome, arguments.options.threads);
  });
}

void write_chart_files(const std::string& folder, const std::string& name,
                       const Distortion& distortion) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError(folder, error.message());
  for (const ChartFile& chart : write_charts(folder, name, distortion)) {
    write_file(chart.path, chart.svg);
  }
}

using Outputs = std::vector<std::pair<std::string, std::string>>;

/// The charts and the report, which are written for folded maps too.
void write_reports(const MapArguments& arguments, const Outcome& outcome, Outputs outputs,
                   const Stopwatch& stopwatch) {
  if (!arguments.charts.empty() && outcome.distortion) {
    const std::string name =
        is_stream(arguments.input) ? "map" : std::filesystem::path(arguments.input).stem().string();
    write_chart_files(arguments.charts, name, *outcome.distortion);
    outputs.emplace_back("charts", arguments.charts);
  }
  if (arguments.json.empty()) return;
  const MapReport report = {.input = {arguments.input, outcome.source},
                            .options = arguments.options,
                            .result = outcome.result,
                            .certificate = outcome.certificate,
                            .distortion = outcome.figures,
                            .outputs = outputs,
                            .seconds = stopwatch.seconds()};
  write_file(arguments.json, to_json(report));
}

/// The map, and before it gets its name everything else: a failure of any leaves no map.
void write_map(const MapArguments& arguments, const Outcome& outcome, const Stopwatch& stopwatch) {
  const std::string& path = arguments.output;
  const std::string bytes = serialise_ply(
      attach_map(outcome.source.file, outcome.result.map, provenance(arguments, outcome)));
  write_file(path, bytes, [&](std::string_view written) {
    const MeshFile file = read_mesh(written, path, own_file);
    require_same_verdict(path, file, read_sphere(file).value(), outcome, arguments.options.threads);
    if (interrupted()) throw Cancelled();
    Outputs outputs = {{"map", path}};
    if (!arguments.sphere.empty()) {
      write_sphere(arguments, outcome);
      outputs.emplace_back("sphere", arguments.sphere);
    }
    write_reports(arguments, outcome, outputs, stopwatch);
  });
}

/// "harmonic: 0.12 s, 3 folds, angle 0.55 area 0.59"
std::string stage_line(const StageRecord& stage) {
  std::string line = "  " + stage.name + ": " + short_number(stage.seconds) + " s";
  if (stage.planar_folds >= 0) line += ", " + std::to_string(stage.planar_folds) + " planar folds";
  if (stage.folds >= 0) line += ", " + std::to_string(stage.folds) + " folds";
  if (stage.distortion) line += ", " + distortion_line(*stage.distortion);
  return line;
}

/// What is odd but harmless, and what the stages did; the paper's method is for those who want to
/// see what each stage does, so it tells without being asked.
void tell_stages(const MapArguments& arguments, const Outcome& outcome, Console& console) {
  for (const std::string& note : outcome.source.notes) console.detail("  note: " + note);
  for (const MeshDefect& defect : outcome.source.inspection.defects) {
    console.detail("  note: " + defect.message);
  }
  for (const StageRecord& stage : outcome.result.stages) {
    const bool asked = arguments.options.method == Method::Paper;
    asked ? console.say(stage_line(stage)) : console.detail(stage_line(stage));
  }
  for (const std::string& warning : outcome.result.warnings) console.warning(warning);
}

std::string advice(const MapArguments& arguments, bool written) {
  if (written) return "  written all the same and marked in its header (--keep-folded)";
  const bool as_printed =
      arguments.options.method == Method::Paper && !arguments.options.repair_paper;
  return as_printed ? "  --repair-map mends it, --keep-folded writes it as it is"
                    : "  --keep-folded writes it as it is";
}

void tell_result(const MapArguments& arguments, const Outcome& outcome, bool written,
                 const Stopwatch& stopwatch, Console& console) {
  const bool certified = outcome.certificate.bijective();
  std::string line = display_name(arguments.input) + ": " +
                     std::to_string(outcome.source.file.mesh.face_count()) + " triangles, " +
                     (certified ? "certified one-to-one" : "not one-to-one: " + outcome.verdict());
  if (outcome.has_map()) line += " (" + outcome.result.made_by + ")";
  if (outcome.figures) line += ", " + distortion_line(*outcome.figures);
  line += ", " + short_number(stopwatch.seconds()) + " s";
  line += written ? " → " + output_name(arguments.output) : ", no map written";
  console.say(line);
  if (!certified) console.say(complaint(outcome.certificate) + advice(arguments, written));
}

int run_map(const MapArguments& arguments) {
  const Stopwatch stopwatch;
  Console console(arguments.loudness.verbosity(), arguments.progress);
  Source source = read_source(arguments.input);
  const OrderlyInterruption orderly;  // from here on there may be files to clean up
  const Outcome outcome = compute(std::move(source), arguments, console);
  tell_stages(arguments, outcome, console);
  const bool writes =
      outcome.has_map() && (outcome.certificate.bijective() || arguments.keep_folded);
  if (writes) {
    write_map(arguments, outcome, stopwatch);
  } else {
    write_reports(arguments, outcome, {}, stopwatch);
  }
  tell_result(arguments, outcome, writes, stopwatch, console);
  return outcome.certificate.bijective() ? Ok : NotCertified;
}

}  // namespace

Command declare_map(CLI::App& program) {
  const auto arguments = std::make_shared<MapArguments>();
  const MapDeclaration declared = declare_map_arguments(program, *arguments);
  return {declared.options, [arguments, settle = declared.settle] {
            settle();
            return run_map(*arguments);
          }};
}

}  // namespace sphparam::tools
