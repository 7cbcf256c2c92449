// All outputs wait under temporary names until what was read back from the disk is certified.

#include "commands/map_outputs.h"

#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "console/exit_codes.h"
#include "console/interruption.h"
#include "console/paths.h"
#include "number_text.h"
#include "report/plots.h"
#include "sphparam/chart/chart_report.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/names.h"
#include "sphparam/records/map_record.h"

namespace sphparam::cli {

namespace {

/// What the map depends on, as options.
std::string options_line(const MapArguments& arguments) {
  if (std::holds_alternative<Method>(arguments.method))
    return sphparam::options_line(arguments.options);
  return arguments.options.repair_paper ? "--repair-map" : "none";
}

Provenance provenance(const MapArguments& arguments, const MapOutcome& outcome) {
  return provenance_of(outcome.result,
                       {.method = info_of(arguments.method).name,
                        .options = options_line(arguments),
                        .citation = outcome.account ? outcome.account->citation : "",
                        .pins = outcome.pins.size(),
                        .verdict = outcome.verdict()},
                       FileNumbers(outcome.source.file));
}

void add_sphere(PendingFiles& files, const MapArguments& arguments, const MapOutcome& outcome,
                Console& console) {
  const ParameterizeOptions& options = arguments.options;
  const std::string& path = arguments.sphere;
  const bool held = !outcome.pins.empty() || options.poles || options.meridian;
  const double least_area = sphparam::add_sphere(
      files, path,
      {outcome.source.file, outcome.topology(), outcome.result.map, outcome.certificate,
       provenance(arguments, outcome)},
      {.energy = options.energy,
       .may_remap = !held,
       .threads = options.threads,
       .progress = [&](std::string_view stage, double f) { return console.progress(stage, f); }});
  if (least_area == 0) return;
  console.say("  " + path + ": mapped anew for numbers of 32 bits: triangles under " +
              short_number(least_area) + " of the mean area count as that large");
}

void add_charts(PendingFiles& files, const std::string& folder, const std::string& name,
                const Distortion& distortion) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError(folder, error.message());
  for (const PlotFile& chart : write_plots(folder, name, distortion)) {
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
  MapRecord record = {.source = outcome.source,
                      .options = arguments.options,
                      .result = outcome.result,
                      .method = info_of(arguments.method).name,
                      .repairs = wanted_repairs(arguments.repair).value_or(RepairOptions::none()),
                      .account = outcome.account,
                      .pins = outcome.pins,
                      .pole_residuals = outcome.pole_residuals(),
                      .distortion = outcome.figures,
                      .chart = figures_of_chart(arguments, outcome, console),
                      .outputs = outputs};
  record.seconds = stopwatch.seconds();
  files.add(arguments.json, to_json(record));
}

/// The mesh gets its map where it stands: a copy of all its attributes would be the peak of memory.
void add_map(PendingFiles& files, const MapArguments& arguments, MapOutcome& outcome) {
  const Provenance lines = provenance(arguments, outcome);
  MeshFile& file = outcome.source.file;
  file = attach_map(std::move(file), outcome.result.map, lines);
  sphparam::add_map(files, arguments.output, file, outcome.topology(), outcome.verdict(),
                    arguments.options.threads);
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
