// All outputs wait under temporary names until what was read back from the disk is certified.

#include "commands/map_outputs.h"

#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "reports/chart_report.h"
#include "console/exit_codes.h"
#include "sphparam/io/file_numbers.h"
#include "console/interruption.h"
#include "reports/json_report.h"
#include "console/paths.h"
#include "commands/repairing.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "io/files/read_back.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "report/plots.h"
#include "embedding/constructions/float32_safe.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

/// What the map depends on, as options.
std::string options_line(const MapArguments& arguments) {
  if (std::holds_alternative<Method>(arguments.method))
    return sphparam::options_line(arguments.options);
  return arguments.options.repair_paper ? "--repair-map" : "none";
}

std::string words(const std::optional<Poles>& poles, const FileNumbers& numbers) {
  if (!poles) return "none";
  return std::to_string(numbers.number(poles->north)) + " " +
         std::to_string(numbers.number(poles->south));
}

Provenance provenance(const MapArguments& arguments, const MapOutcome& outcome,
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

/// The radius that FreeSurfer, HCP and MSM give their spheres; areas are compared at it.
constexpr double gifti_radius = 100;

/// GIFTI has coordinates of 32 bits. Rounding must not cost a certified map its certificate; one
/// that is folded anyway may get other folds.
Sphere sphere_for(const std::string& path, const MapOutcome& outcome,
                  const ParameterizeOptions& options) {
  if (extension_of(path) != ".gii") {
    return {outcome.result.map, outcome.verdict()};
  }
  auto [rounding, least_area] =
      round_with_room(outcome.source.file.mesh, outcome.topology(), outcome.result.map,
                      {.energy = options.energy,
                       .radius = gifti_radius,
                       .threads = options.threads,
                       .progress = options.progress});
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

void add_sphere(PendingFiles& files, const MapArguments& arguments, const MapOutcome& outcome,
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

/// Figures alone are not worth the memory of a chart that somebody bakes for or exports; where
/// there is too little even for these, the map is none the worse.
std::optional<ChartReport> affordable_chart(const MapArguments& arguments,
                                            const MapOutcome& outcome, Console& console) try {
  constexpr int splits_a_vertex = 4;
  return report_chart(
      outcome.source.file.mesh, outcome.result.map, arguments.options.threads,
      [&](std::string_view stage, double f) { return console.progress(stage, f); },
      splits_a_vertex);
} catch (const std::bad_alloc&) {
  return ChartReport{.not_made = "out of memory"};
}

/// The figures of the (u, v) chart, as a stage of its own. The map that was asked for is written
/// and certified by now, under its temporary name: a chart that cannot be made is told, and costs
/// nothing else.
std::optional<ChartReport> figures_of_chart(const MapArguments& arguments, MapOutcome& outcome,
                                            Console& console) {
  if (!outcome.certificate.bijective()) return std::nullopt;
  const Stopwatch stopwatch;
  std::optional<ChartReport> chart = affordable_chart(arguments, outcome, console);
  outcome.result.stages.push_back({.name = "chart", .seconds = stopwatch.seconds()});
  console.detail("  chart: " + short_number(stopwatch.seconds()) + " s");
  if (chart && !chart->not_made.empty()) {
    outcome.result.warnings.push_back(chart_line(chart));
    console.warning(chart_line(chart));
  }
  return chart;
}

/// The charts and the report, which are written for folded maps too.
void add_reports(PendingFiles& files, const MapArguments& arguments, MapOutcome& outcome,
                 Outputs outputs, const Stopwatch& stopwatch, Console& console) {
  if (!arguments.charts.empty() && outcome.distortion) {
    const std::string name =
        is_stream(arguments.input) ? "map" : std::filesystem::path(arguments.input).stem().string();
    add_charts(files, arguments.charts, name, *outcome.distortion);
    outputs.emplace_back("charts", arguments.charts);
  }
  if (arguments.json.empty()) return;
  const std::optional<ChartReport> chart = figures_of_chart(arguments, outcome, console);
  const MapReport report = {
      .input = {arguments.input, outcome.source},
      .method = info_of(arguments.method).name,
      .options = arguments.options,
      .repairs_wanted = words_of(wanted_repairs(arguments.repair).value_or(RepairOptions::none())),
      .result = outcome.result,
      .account = outcome.account,
      .pins = outcome.pins,
      .pole_residuals = outcome.pole_residuals(),
      .certificate = outcome.certificate,
      .distortion = outcome.figures,
      .chart = chart,
      .outputs = outputs,
      .seconds = stopwatch.seconds()};
  files.add(arguments.json, to_json(report));
}

/// The mesh gets its map where it stands: a copy of all its attributes would be the peak of memory.
void add_map(PendingFiles& files, const MapArguments& arguments, MapOutcome& outcome) {
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

}  // namespace

void write_outputs(const MapArguments& arguments, MapOutcome& outcome, bool with_map,
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
  add_reports(files, arguments, outcome, outputs, stopwatch, console);
  if (interrupted()) throw Cancelled();
  files.publish();
}

}  // namespace sphparam::cli
