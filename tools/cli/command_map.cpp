// `sphparam map`: file → mesh → map → proof → file. The map waits under a temporary name until what
// was read back from the disk is certified and everything else is written; then it is renamed.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/choice.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_codes.h"
#include "cli/interruption.h"
#include "cli/json_report.h"
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

constexpr char summary[] =
    "Map a closed genus-0 mesh one-to-one onto the unit sphere, prove it, write it.\n"
    "\n"
    "Examples:\n"
    "  sphparam map statue.obj -o statue.sph.ply\n"
    "  sphparam map statue.ply -o statue.sph.ply --json map.json --charts charts/\n"
    "  sphparam map statue.off -o statue.sph.ply --sphere sphere.obj --poles 17,4203\n"
    "  cat statue.obj | sphparam map - -o - > statue.sph.ply\n"
    "  sphparam map statue.obj -o folded.sph.ply --method paper --keep-folded\n";

struct MapArguments {
  std::string input;
  std::string output;
  std::string sphere;  // empty: not wanted; so are:
  std::string json;
  std::string charts;
  std::string poles = "auto";
  bool keep_folded = false;
  ProgressStyle progress = ProgressStyle::Auto;
  Loudness loudness;
  ParameterizeOptions options;
};

/// "17,23" → vertices 17 and 23.
std::optional<Poles> parse_poles(const std::string& text) {
  if (text == "auto") return std::nullopt;
  Poles poles{};
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%d,%d%c", &poles.north, &poles.south, &rest);
  if (read != 2 || poles.north < 0 || poles.south < 0 || poles.north == poles.south) {
    throw UsageMistake("--poles: expected auto or two different vertices, as in 17,23");
  }
  return poles;
}

using Serialiser = std::string (*)(const MeshFile&);

/// By the extension of the name; null for an unknown one.
Serialiser serialiser(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension();
  if (extension == ".ply") return serialise_ply;
  if (extension == ".obj") return serialise_obj;
  if (extension == ".off") return serialise_off;
  return nullptr;
}

void require_sensible(const MapArguments& arguments) {
  if (is_stream(arguments.output) && is_stream(arguments.json)) {
    throw UsageMistake("-o - and --json - cannot both go to standard output");
  }
  if (!arguments.sphere.empty() && !serialiser(arguments.sphere)) {
    throw UsageMistake("--sphere: the name must end in .ply, .obj or .off");
  }
}

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

Outcome compute(Source source, const MapArguments& arguments, Console& console) {
  Outcome outcome = {.source = std::move(source)};
  if (!outcome.source.inspection.is_sphere()) throw MeshError(outcome.source.inspection.defects);
  const TriangleMesh& mesh = outcome.source.file.mesh;
  ParameterizeOptions options = arguments.options;
  options.progress = [&](std::string_view stage, double f) { return console.progress(stage, f); };
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
    const MeshFile file = read_mesh(written, path, ReadOptions{});
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
    const MeshFile file = read_mesh(written, path, ReadOptions{});
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

/// Options that only the paper's method reads.
std::vector<CLI::Option*> add_paper_options(CLI::App& command, MapArguments& arguments) {
  PaperSettings& paper = arguments.options.paper;
  const std::string group = "With --method paper";
  return {add_choice<WeightKind>(command, "--weights", paper.weights,
                                 {{name_of(WeightKind::MeanValue), WeightKind::MeanValue},
                                  {name_of(WeightKind::Cotangent), WeightKind::Cotangent}},
                                 "mean-value (default) or cotangent")
              ->type_name("KIND")
              ->group(group),
          command.add_option("--epsilon", paper.epsilon, "phi of the ring about a pole")
              ->check(between(1e-9, 1.5, "1e-9 to 1.5"))
              ->type_name("RADIANS")
              ->capture_default_str()
              ->group(group),
          command.add_option("--iterations", paper.iterations, "Quasi-harmonic iterations")
              ->check(between(0, 1000, "0 to 1000"))
              ->type_name("N")
              ->capture_default_str()
              ->group(group),
          command.add_option("--rings", paper.rings, "Rings about the date line that are smoothed")
              ->check(between(0, 1000, "0 to 1000"))
              ->type_name("N")
              ->capture_default_str()
              ->group(group),
          command.add_option("--sweeps", paper.sweeps, "Sweeps of tangential smoothing")
              ->check(between(0, 1000, "0 to 1000"))
              ->type_name("N")
              ->capture_default_str()
              ->group(group)};
}

void add_files(CLI::App& command, MapArguments& arguments) {
  command.add_option("MESH", arguments.input, "OBJ, PLY or OFF; - for standard input")
      ->type_name(" ")
      ->required();
  command.add_option("-o,--output", arguments.output, "The map, a .sph.ply; - for standard output")
      ->type_name("FILE")
      ->required();
  command.add_option("--sphere", arguments.sphere, "The bare sphere too: .ply, .obj or .off")
      ->type_name("FILE");
  command.add_option("--json", arguments.json, "A report; - for standard output")
      ->type_name("FILE");
  command.add_option("--charts", arguments.charts, "The distortion as SVG charts")
      ->type_name("FOLDER");
}

void add_method(CLI::App& command, MapArguments& arguments) {
  ParameterizeOptions& options = arguments.options;
  add_choice<Method>(command, "--method", options.method,
                     {{name_of(Method::Progressive), Method::Progressive},
                      {name_of(Method::Curvilinear), Method::Curvilinear},
                      {name_of(Method::Paper), Method::Paper}},
                     "progressive (default), curvilinear, or paper: as printed, folds and all")
      ->type_name("METHOD");
  command.add_option("--poles", arguments.poles, "Vertices that go to +z and -z, as 17,4203")
      ->type_name("auto|V1,V2")
      ->capture_default_str();
  command.add_option("--lambda", options.energy.lambda, "Weight of area against angle")
      ->check(between(1e-8, 1e3, "1e-8 to 1000"))
      ->type_name("NUMBER")
      ->capture_default_str();
  command.add_flag("--repair-map", options.repair_paper, "Untangle what --method paper folds");
  command.add_flag("--keep-folded", arguments.keep_folded,
                   "Write a folded map too, marked in its header; still ends with 5");
  command.add_option("--threads", options.threads, "How many threads (0: all cores); same bytes")
      ->check(between(0, 4096, "0 to 4096"))
      ->type_name("N")
      ->capture_default_str();
}

void add_progress(CLI::App& command, MapArguments& arguments) {
  add_choice<ProgressStyle>(
      command, "--progress", arguments.progress,
      {{"auto", ProgressStyle::Auto}, {"none", ProgressStyle::None}, {"json", ProgressStyle::Json}},
      "auto (on a terminal), none or json")
      ->type_name("STYLE");
}

}  // namespace

Command declare_map(CLI::App& program) {
  const auto arguments = std::make_shared<MapArguments>();
  CLI::App* command = program.add_subcommand("map", summary);
  add_files(*command, *arguments);
  add_method(*command, *arguments);
  const std::vector<CLI::Option*> paper_only = add_paper_options(*command, *arguments);
  add_progress(*command, *arguments);
  add_loudness(*command, arguments->loudness);
  return {command, [arguments, paper_only] {
            for (const CLI::Option* option : paper_only) {
              if (option->count() > 0 && arguments->options.method != Method::Paper) {
                throw UsageMistake(option->get_name() + " is for --method paper only");
              }
            }
            require_sensible(*arguments);
            arguments->options.poles = parse_poles(arguments->poles);
            arguments->options.measure_stages =
                arguments->options.method == Method::Paper || arguments->loudness.verbose;
            return run_map(*arguments);
          }};
}

}  // namespace sphparam::tools
