// `sphparam map`: file → mesh → map → proof → file. All outputs wait under temporary names until
// what was read back from the disk is certified; then all are renamed, or none.

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/chart_report.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/file_numbers.h"
#include "cli/interruption.h"
#include "cli/json_report.h"
#include "cli/map_arguments.h"
#include "cli/paths.h"
#include "cli/pin_file.h"
#include "cli/repairing.h"
#include "cli/source.h"
#include "cli/wording.h"
#include "compare/methods.h"
#include "image/file_extension.h"
#include "mesh_io/mesh_reader.h"
#include "mesh_io/mesh_writer.h"
#include "mesh_io/read_back.h"
#include "mesh_io/safe_file.h"
#include "mesh_io/sphere_file.h"
#include "report/charts.h"
#include "sphparam/embedding/float_room.h"
#include "sphparam/embedding/landmarks.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/parameterize.h"
#include "sphparam/stopwatch.h"
#include "sphparam/version.h"

namespace sphparam::tools {

namespace {

/// What one run found. `certificate` is of the map in memory; what is written must have the same
/// verdict when it is read back.
struct Outcome {
  Source source;
  Parameterization result = {};
  std::optional<RivalAccount> account = std::nullopt;  // of a method of others
  Certificate certificate = {};
  std::optional<Distortion> distortion = std::nullopt;
  std::optional<DistortionSummary> figures = std::nullopt;
  std::vector<Landmark> pins = {};  // vertices of the mesh

  /// The paper's method makes none where no pair of poles is usable.
  bool has_map() const { return result.map.points.rows() > 0; }
  /// Every pin exactly where it was wanted; also where none was.
  bool pins_hold() const {
    return pins.empty() ||
           (result.pin_residuals.size() == pins.size() && all_exact(result.pin_residuals));
  }
  /// What the program is for: exit code 0.
  bool succeeded() const { return certificate.bijective() && pins_hold(); }
  const Topology& topology() const { return source.topology.value(); }
  std::string verdict() const { return has_map() ? tools::verdict(certificate) : "no map"; }
};

/// Poles, meridian and pins as vertices of the mesh.
void settle_vertices(const MapArguments& arguments, const MeshFile& file,
                     ParameterizeOptions& options) {
  if (!options.poles && !options.meridian && arguments.pins.empty()) return;
  const FileNumbers numbers(file);
  const auto vertex = [&](const char* option, Vertex number) {
    const Vertex found = numbers.vertex(number);
    if (found < 0) throw UsageMistake(std::string(option) + ": " + numbers.absence(number));
    return found;
  };
  if (options.poles) {
    options.poles =
        Poles{vertex("--poles", options.poles->north), vertex("--poles", options.poles->south)};
  }
  if (options.meridian) options.meridian = vertex("--meridian", *options.meridian);
  if (arguments.pins.empty()) return;
  options.pins = read_pins(arguments.pins, numbers);
  for (const Landmark& pin : options.pins) {
    if (options.poles &&
        (pin.vertex == options.poles->north || pin.vertex == options.poles->south)) {
      throw UsageMistake("--pin: vertex " + std::to_string(numbers.number(pin.vertex)) +
                         " is one of the --poles");
    }
  }
}

Outcome compute(Source source, const MapArguments& arguments, Console& console) {
  Outcome outcome = {.source = std::move(source)};
  require_mappable(outcome.source);
  const TriangleMesh& mesh = outcome.source.file.mesh;
  ParameterizeOptions options = arguments.options;
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
  settle_vertices(arguments, outcome.source.file, options);
  outcome.pins = options.pins;
  MethodRun run = run_method(arguments.method, mesh, outcome.topology(), options);
  outcome.result = std::move(run.result);
  outcome.account = std::move(run.account);
  outcome.certificate = outcome.result.certificate;
  if (outcome.has_map()) {
    outcome.distortion = measure_distortion(mesh, outcome.result.map, options.threads);
    outcome.figures = summarise(*outcome.distortion, options.threads);
  }
  return outcome;
}

/// What the map depends on, as options.
std::string options_line(const MapArguments& arguments) {
  if (std::holds_alternative<Method>(arguments.method))
    return tools::options_line(arguments.options);
  return arguments.options.repair_paper ? "--repair-map" : "none";
}

std::string words(const std::optional<Poles>& poles, const FileNumbers& numbers) {
  if (!poles) return "none";
  return std::to_string(numbers.number(poles->north)) + " " +
         std::to_string(numbers.number(poles->south));
}

Provenance provenance(const MapArguments& arguments, const Outcome& outcome,
                      const std::string& verdict) {
  const FileNumbers numbers(outcome.source.file);
  Provenance lines = {{"version", version},
                      {"method", info_of(arguments.method).name},
                      {"stage", outcome.result.made_by},
                      {"options", options_line(arguments)},
                      {"poles", words(outcome.result.poles, numbers)}};
  if (outcome.account) lines.emplace_back("after", outcome.account->citation);
  if (outcome.result.meridian) {
    lines.emplace_back("meridian", std::to_string(numbers.number(*outcome.result.meridian)));
  }
  if (!outcome.pins.empty()) lines.emplace_back("pins", std::to_string(outcome.pins.size()));
  lines.emplace_back("verdict", verdict);
  return lines;
}

/// Throws NotCertifiedError unless the bytes of a written map hold what was found in memory.
void require_verdict(const std::string& expected, const std::string& path,
                     const Certificate& on_disk) {
  if (verdict(on_disk) != expected) {
    throw NotCertifiedError(path + ": as written, the map is " + verdict(on_disk));
  }
}

/// A map as a file can hold it, and what is to be said of it there.
struct Sphere {
  SphereMap map;
  std::string verdict;
  double least_area = 0;  // of triangles, of the mean: what they had to be taken for
};

/// GIFTI has coordinates of 32 bits. Rounding must not cost a certified map its certificate; one
/// that is folded anyway may get other folds.
Sphere sphere_for(const std::string& path, const Outcome& outcome,
                  const ParameterizeOptions& options) {
  if (extension_of(path) != ".gii") {
    return {outcome.result.map, outcome.verdict()};
  }
  auto [rounding, least_area] = round_with_room(
      outcome.source.file.mesh, outcome.topology(), outcome.result.map,
      {.energy = options.energy, .threads = options.threads, .progress = options.progress});
  const bool held = !outcome.pins.empty() || options.poles || options.meridian;
  if (least_area > 0 && held) {
    throw NotCertifiedError(path +
                            ": numbers of 32 bits cannot hold this map with its pins, poles or "
                            "meridian; .ply, .obj and .off can");
  }
  const bool certified = outcome.certificate.bijective();
  if (certified && !rounding.certificate.bijective()) {
    throw NotCertifiedError(path + ": numbers of 32 bits cannot hold this map (" +
                            verdict(rounding.certificate) + "); .ply, .obj and .off can");
  }
  return {std::move(rounding.map), certified ? outcome.verdict() : verdict(rounding.certificate),
          least_area};
}

void add_sphere(PendingFiles& files, const MapArguments& arguments, const Outcome& outcome,
                Console& console) {
  const std::string& path = arguments.sphere;
  ParameterizeOptions options = arguments.options;
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
  const Sphere sphere = sphere_for(path, outcome, options);
  Provenance lines = provenance(arguments, outcome, sphere.verdict);
  if (sphere.least_area > 0) {
    std::erase_if(lines, [](const auto& line) {  // they are of the other map
      return line.first == "poles" || line.first == "meridian";
    });
    console.say("  " + path + ": mapped anew for numbers of 32 bits: triangles under " +
                short_number(sphere.least_area) + " of the mean area count as that large");
  }
  std::string bytes =
      serialiser(path)(sphere_mesh(outcome.source.file, sphere.map, std::move(lines)));
  files.add(path, std::move(bytes), [&](std::string_view written) {
    const MeshFile file = read_mesh(written, path, own_map);
    require_verdict(sphere.verdict, path,
                    certify_read_back(file, {file.mesh.positions}, outcome.topology(),
                                      arguments.options.threads));
  });
}

void add_charts(PendingFiles& files, const std::string& folder, const std::string& name,
                const Distortion& distortion) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError(folder, error.message());
  for (const ChartFile& chart : write_charts(folder, name, distortion)) {
    files.add(chart.path, chart.svg);
  }
}

/// The charts and the report, which are written for folded maps too.
void add_reports(PendingFiles& files, const MapArguments& arguments, const Outcome& outcome,
                 Outputs outputs, const Stopwatch& stopwatch) {
  if (!arguments.charts.empty() && outcome.distortion) {
    const std::string name =
        is_stream(arguments.input) ? "map" : std::filesystem::path(arguments.input).stem().string();
    add_charts(files, arguments.charts, name, *outcome.distortion);
    outputs.emplace_back("charts", arguments.charts);
  }
  if (arguments.json.empty()) return;
  std::optional<ChartReport> chart;
  if (outcome.certificate.bijective()) {
    chart = report_chart(outcome.source.file.mesh, outcome.result.map, arguments.options.threads);
  }
  const MapReport report = {
      .input = {arguments.input, outcome.source},
      .method = info_of(arguments.method).name,
      .options = arguments.options,
      .repairs_wanted = words_of(wanted_repairs(arguments.repair).value_or(RepairOptions::none())),
      .result = outcome.result,
      .account = outcome.account,
      .pins = outcome.pins,
      .certificate = outcome.certificate,
      .distortion = outcome.figures,
      .chart = chart,
      .outputs = outputs,
      .seconds = stopwatch.seconds()};
  files.add(arguments.json, to_json(report));
}

/// The mesh gets its map where it stands: a copy of all its attributes would be the peak of memory.
void add_map(PendingFiles& files, const MapArguments& arguments, Outcome& outcome) {
  const std::string& path = arguments.output;
  const Provenance lines = provenance(arguments, outcome, outcome.verdict());
  MeshFile& file = outcome.source.file;
  file = attach_map(std::move(file), outcome.result.map, lines);
  files.add(path, serialise_ply(file), [&](std::string_view written) {
    const MeshFile reread = read_mesh(written, path, own_map);
    require_verdict(outcome.verdict(), path,
                    certify_read_back(reread, read_sphere(reread).value(), outcome.topology(),
                                      arguments.options.threads));
  });
}

/// All outputs, or, where one fails, none.
void write_outputs(const MapArguments& arguments, Outcome& outcome, bool with_map,
                   const Stopwatch& stopwatch, Console& console) {
  PendingFiles files;
  Outputs outputs;
  if (with_map) {
    add_map(files, arguments, outcome);
    outputs.emplace_back("map", arguments.output);
  }
  if (with_map && !arguments.sphere.empty()) {
    add_sphere(files, arguments, outcome, console);
    outputs.emplace_back("sphere", arguments.sphere);
  }
  add_reports(files, arguments, outcome, outputs, stopwatch);
  if (interrupted()) throw Cancelled();
  files.publish();
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
  for (const RepairAction& repair : outcome.source.repairs) console.say("  " + repair.message);
  for (const MeshDefect& defect : outcome.source.inspection.defects) {
    // What looks wrong on the map is told unasked.
    const bool visible = defect.kind == DefectKind::InsideOut;
    visible ? console.warning(defect.message + ": " + defect.hint)
            : console.detail("  note: " + defect.message);
  }
  if (outcome.account) {
    console.say("  " + outcome.account->citation + ": " + outcome.account->statement);
  }
  for (const StageRecord& stage : outcome.result.stages) {
    const bool asked = arguments.method == AnyMethod(Method::Paper);
    asked ? console.say(stage_line(stage)) : console.detail(stage_line(stage));
  }
  for (const std::string& warning : outcome.result.warnings) console.warning(warning);
}

/// What holding the given vertices cost; with -v also what automatic poles cost.
void tell_frame(const MapArguments& arguments, const Outcome& outcome, Console& console) {
  const Parameterization& result = outcome.result;
  const bool given = arguments.options.poles || !arguments.pins.empty();
  if (!outcome.succeeded() || (!result.poles && outcome.pins.empty())) return;
  const FileNumbers numbers(outcome.source.file);
  std::string line = "  ";
  if (result.poles) {
    line += "vertices " + std::to_string(numbers.number(result.poles->north)) + " and " +
            std::to_string(numbers.number(result.poles->south)) + " at ±z";
  }
  if (!outcome.pins.empty()) {
    line += (result.poles ? ", " : "") + std::to_string(outcome.pins.size()) + " pinned";
  }
  const double percent = 100 * result.pole_cost;
  line += ": " + short_number(std::abs(percent)) + " % " + (percent < 0 ? "less" : "more") +
          " energy than before";
  given ? console.say(line) : console.detail(line);
}

/// Every pin that is not at its point, by its number in the file.
std::string complaint_of_pins(const Outcome& outcome) {
  if (outcome.pins_hold() || outcome.result.pin_residuals.size() != outcome.pins.size()) return "";
  const FileNumbers numbers(outcome.source.file);
  std::string lines;
  for (size_t i = 0; i < outcome.pins.size(); ++i) {
    const double residual = outcome.result.pin_residuals[i];
    if (residual == 0) continue;
    lines += "  pin " + std::to_string(numbers.number(outcome.pins[i].vertex)) + " is " +
             short_number(residual) + " radians from its point\n";
  }
  return lines;
}

std::string advice(const MapArguments& arguments, bool written) {
  if (written) return "  written all the same and marked in its header (--keep-folded)";
  const bool ours = arguments.method == AnyMethod(Method::Progressive) ||
                    arguments.method == AnyMethod(Method::Curvilinear);
  const bool as_printed = !ours && !arguments.options.repair_paper;
  return as_printed ? "  --repair-map mends it, --keep-folded writes it as it is"
                    : "  --keep-folded writes it as it is";
}

void tell_result(const MapArguments& arguments, const Outcome& outcome, bool written,
                 const Stopwatch& stopwatch, Console& console) {
  const bool certified = outcome.certificate.bijective();
  std::string line = display_name(arguments.input) + ": " +
                     std::to_string(outcome.source.file.mesh.face_count()) + " triangles, " +
                     (!certified            ? "not one-to-one: " + outcome.verdict()
                      : outcome.pins_hold() ? "certified one-to-one"
                                            : "one-to-one, but pins are not at their points");
  if (outcome.has_map()) line += " (" + outcome.result.made_by + ")";
  if (outcome.figures) line += ", " + distortion_line(*outcome.figures);
  line += ", " + short_number(stopwatch.seconds()) + " s";
  line += written ? " → " + output_name(arguments.output) : ", no map written";
  console.say(line);
  if (!certified) console.say(complaint(outcome.certificate) + advice(arguments, written));
  if (!outcome.pins_hold())
    console.say(complaint_of_pins(outcome) + "  no map is written without them");
}

/// The mesh, after the repairs that are wanted.
Source read_mended(const MapArguments& arguments) {
  const std::optional<RepairOptions> repairs = wanted_repairs(arguments.repair);
  ReadOptions options = input_limits();
  options.repeated_corners = repairs && repairs->duplicates;
  Source source = read_source(arguments.input, options);
  if (!repairs) return source;
  return repaired(std::move(source), *repairs);
}

int run_map(const MapArguments& arguments) {
  const Stopwatch stopwatch;
  Console console(arguments.loudness.verbosity(), arguments.progress);
  Source source = read_mended(arguments);
  const OrderlyInterruption orderly;  // from here on there may be files to clean up
  Outcome outcome = compute(std::move(source), arguments, console);
  tell_stages(arguments, outcome, console);
  tell_frame(arguments, outcome, console);
  const bool writes = outcome.has_map() && outcome.pins_hold() &&
                      (outcome.certificate.bijective() || arguments.keep_folded);
  write_outputs(arguments, outcome, writes, stopwatch, console);
  try {
    tell_result(arguments, outcome, writes, stopwatch, console);
  } catch (const std::bad_alloc&) {  // what is on disk is there all the same
  }
  return outcome.succeeded() ? Ok : NotCertified;
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
