// All outputs wait under temporary names until what was read back from the disk is certified.

#include "commands/map_outputs.h"

#include <filesystem>
#include <new>
#include <utility>

#include "arguments/part_files.h"
#include "console/places.h"
#include "io/polygons/welding.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "report/plots.h"
#include "reports/told_losses.h"
#include "sphparam/chart/chart_failure.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/loop_file.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/names.h"
#include "sphparam/records/map_record.h"

namespace sphparam::cli {

namespace {

/// What the map depends on, as options.
std::string options_line(const MapOutcome& outcome) {
  if (outcome.likeness) return "--like " + outcome.other;
  if (std::holds_alternative<Method>(outcome.method))
    return sphparam::options_line(outcome.options);
  return outcome.options.repair_paper ? "--repair-map" : "none";
}

Provenance provenance(const MapOutcome& outcome) {
  return provenance_of(outcome.result,
                       {.method = outcome.likeness ? "like" : info_of(outcome.method).name,
                        .options = options_line(outcome),
                        .citation = outcome.account ? outcome.account->citation : "",
                        .pins = outcome.options.pins.size(),
                        .upright = outcome.upright,
                        .verdict = outcome.verdict()},
                       FileNumbers(outcome.source.file));
}

/// The mesh gets its map where it stands: one copy of all its attributes, as they are read back, is
/// the peak of memory.
void add_map(const MapArguments& arguments, MapOutcome& outcome, Session& session) {
  const std::string& path = arguments.output;
  Provenance lines = provenance(outcome);
  if (!arguments.component.empty()) lines.emplace_back(component_key, arguments.component);
  MeshFile& file = outcome.source.file;
  std::vector<std::string> losses;
  add_polygon_loss(losses, file);
  add_replaced(losses, file);
  file = attach_map(std::move(file), outcome.result.map, lines);
  const std::vector<std::string> more = sphparam::add_map(
      session.files, path, file, outcome.topology(), outcome.verdict(), session.threads());
  losses.insert(losses.end(), more.begin(), more.end());
  tell_losses(path, losses, session.console);
  std::vector<std::string>& notes = outcome.source.notes;
  notes.insert(notes.end(), losses.begin(), losses.end());
}

void add_sphere(const std::string& path, const MapArguments& arguments, const MapOutcome& outcome,
                Session& session) {
  const ParameterizeOptions& options = outcome.options;
  const double least_area = sphparam::add_sphere(
      session.files, path,
      {outcome.source.file, outcome.topology(), outcome.result.map, outcome.result.certificate,
       provenance(outcome)},
      {.energy = options.energy,
       .may_remap = options.pins.empty() && !options.poles && !options.meridian &&
                    !options.align_to && !outcome.likeness && options.method != Method::Radial,
       .origin = arguments.input,
       .threads = session.threads(),
       .progress = session.progress()});
  if (least_area == 0) return;
  session.console.say("  " + path + ": mapped anew for numbers of 32 bits: triangles under " +
                      short_number(least_area) + " of the mean area count as that large");
}

/// A sphere of other vertices than the file's fits none that is there, but that of -o.
void tell_whose_sphere(const MapArguments& arguments, const MapOutcome& outcome, Session& session) {
  const bool is_mended = !outcome.source.repairs.empty();
  const std::vector<std::string> renumbered = renumberings_among(outcome.source.notes);
  const auto say = [&](const std::string& words) {
    session.console.say("  " + output_name(arguments.sphere) + ": " + words);
  };
  if (!is_mended && !renumbered.empty())
    say("its vertices are not the rows of " + display_name(arguments.input) + ": " +
        joined(renumbered, "; "));
  if (!arguments.output.empty() || (!is_mended && renumbered.empty())) return;
  say("is of the " + std::string(is_mended ? "mended mesh" : "mesh as it was mapped") +
      ", which no file holds: `sphparam repair " + shell_file(arguments.input) +
      (is_mended ? typed_again(arguments.repair) : " --repair=unused") + " -o MENDED` writes it");
}

void add_plots(const std::string& folder, const std::string& name, const Distortion& distortion,
               PendingFiles& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteError(folder, error.message());
  for (const PlotFile& plot : write_plots(folder, name, distortion)) files.add(plot.path, plot.svg);
}

/// Figures alone are not worth the memory of a chart that somebody bakes for or exports; where
/// there is too little even for these, the map is none the worse.
std::optional<ChartReport> affordable_chart(const MapOutcome& outcome, Session& session) try {
  constexpr int splits_a_vertex = 4;
  return report_chart(outcome.source.file.mesh, outcome.result.map, session.threads(),
                      session.progress(), splits_a_vertex);
} catch (const std::bad_alloc&) {
  return ChartReport{.not_made = "out of memory"};
}

/// Is the chart certified, with all vertices where the map has them?
bool stands_as_it_is(const ChartReport& chart) {
  return chart.not_made.empty() && chart.certificate.one_to_one() &&
         moved_vertices(chart.counts, chart.certificate, chart.vertices).empty();
}

/// Has the chart more than twice the vertices of its mesh, and not for their being few?
bool is_large(const ChartReport& chart, const MapOutcome& outcome) {
  constexpr long few = 64;
  return chart.vertices > 2 * outcome.source.file.mesh.vertex_count() + few;
}

void warn(const std::string& line, MapOutcome& outcome, Session& session) {
  outcome.result.warnings.push_back(line);
  session.console.warning(line);
}

/// The figures of the (u, v) chart, as a stage of its own. The map that was asked for is written
/// and certified by now, under its temporary name: a chart that cannot be made is told, and costs
/// nothing else.
std::optional<ChartReport> figures_of_chart(MapOutcome& outcome, Session& session) {
  if (!outcome.bijective()) return std::nullopt;
  const Stopwatch stopwatch;
  std::optional<ChartReport> chart = affordable_chart(outcome, session);
  outcome.result.stages.push_back({.name = "chart", .seconds = stopwatch.seconds()});
  session.console.detail("  chart: " + short_number(stopwatch.seconds()) + " s");
  if (chart && !stands_as_it_is(*chart)) {
    warn(chart_line(chart), outcome, session);
  } else if (chart && is_large(*chart, outcome)) {
    warn(chart_line(chart) + ": more than twice the vertices of the mesh", outcome, session);
  }
  return chart;
}

/// Whether a chart stands is told of every map that is written, but of large ones, where it would
/// be the peak of memory.
bool is_told_of_chart(const MapArguments& arguments, const MapOutcome& outcome) {
  constexpr Eigen::Index most_triangles = 1'000'000;
  return !arguments.quiet && !arguments.output.empty() &&
         outcome.source.file.mesh.face_count() <= most_triangles;
}

std::string report_on(const MapArguments& arguments, MapOutcome& outcome, const Outputs& outputs,
                      Session& session) {
  MapRecord record = {.source = outcome.source,
                      .options = arguments.options,
                      .result = outcome.result,
                      .method = outcome.likeness ? "like" : info_of(arguments.method).name,
                      .repairs = wanted_repairs(arguments.repair).value_or(RepairOptions::none()),
                      .account = outcome.account,
                      .pins = outcome.options.pins,
                      .pole_residuals = outcome.frame.pole_residuals,
                      .upright = outcome.upright,
                      .likeness = outcome.likeness,
                      .other = outcome.other,
                      .distortion = outcome.figures,
                      .chart = figures_of_chart(outcome, session),
                      .outputs = outputs,
                      .input = outcome.input};
  record.seconds = session.stopwatch.seconds();
  return to_json(record);
}

}  // namespace

std::string add_outputs(const MapArguments& arguments, MapOutcome& outcome, bool with_map,
                        Session& session) {
  Outputs outputs;
  if (with_map && !arguments.output.empty()) {
    add_map(arguments, outcome, session);
    outputs.emplace_back("map", arguments.output);
  }
  if (with_map && !arguments.sphere.empty()) {
    add_sphere(arguments.sphere, arguments, outcome, session);
    if (!arguments.all_components) tell_whose_sphere(arguments, outcome, session);
    outputs.emplace_back("sphere", arguments.sphere);
  }
  if (!arguments.repair.loops.empty()) {
    session.files.add(arguments.repair.loops,
                      serialise_loops(arguments.repair.loops, outcome.source.handles));
    outputs.emplace_back("loops", arguments.repair.loops);
  }
  // Plots and report are written for folded maps too.
  if (!arguments.plots.empty() && outcome.distortion) {
    add_plots(arguments.plots, stem_or(arguments.input, "map"), *outcome.distortion, session.files);
    outputs.emplace_back("charts", arguments.plots);
  }
  if (!arguments.json.empty()) return report_on(arguments, outcome, outputs, session);
  if (with_map && is_told_of_chart(arguments, outcome)) figures_of_chart(outcome, session);
  return "";
}

void write_outputs(const MapArguments& arguments, MapOutcome& outcome, bool with_map,
                   Session& session) {
  const std::string report = add_outputs(arguments, outcome, with_map, session);
  session.add_report([&] { return report; });
  session.publish();
}

}  // namespace sphparam::cli
