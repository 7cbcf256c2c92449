// `sphparam remesh`: a mapped mesh → a grid of the sphere → the mesh on that grid, whose map the
// grid's directions are. What was written is read back and certified before it gets its name.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "sphparam/io/certified_files.h"
#include "console/exit_codes.h"
#include "commands/flat_comparison.h"
#include "console/interruption.h"
#include "commands/like_grid.h"
#include "commands/mapped_source.h"
#include "commands/measurable.h"
#include "console/paths.h"
#include "commands/remesh_adaptive.h"
#include "arguments/remesh_arguments.h"
#include "commands/remesh_displacement.h"
#include "commands/remesh_glb.h"
#include "commands/remesh_images.h"
#include "commands/remesh_lods.h"
#include "reports/remesh_report.h"
#include "commands/remesh_subdivision.h"
#include "reports/wording.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "remesh/sample_table.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/stopwatch.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace {

constexpr std::string_view like_prefix = "like:";

std::string kind_of(const std::string& path) {
  return is_stream(path) ? ".ply" : extension_of(path);
}

std::optional<GridSpec> grid_asked_for(const RemeshArguments& arguments) {
  if (arguments.grid == like_prefix)
    throw UsageMistake("--grid like: names no mesh, as in like:MESH");
  if (arguments.grid.starts_with(like_prefix)) return std::nullopt;
  try {
    return parse_grid(arguments.grid);
  } catch (const std::invalid_argument& error) {
    throw UsageMistake("--grid " + arguments.grid + ": " + error.what());
  }
}

void check_outputs(const RemeshArguments& arguments) {
  const std::string kind = kind_of(arguments.output);
  if (!arguments.output.empty() && kind != ".ply" && kind != ".obj" && kind != ".glb") {
    throw UsageMistake("-o: the new mesh is written as .ply, .obj or .glb, not as " +
                       output_name(arguments.output));
  }
  if (arguments.output.empty() && arguments.limit_output.empty() && arguments.csv.empty() &&
      arguments.displacement.empty() && images_asked_for(arguments).empty()) {
    throw UsageMistake("nothing to write: give -o, --geometry-image or --csv");
  }
}

void check_all_places(const RemeshArguments& arguments,
                      const std::vector<RemeshArguments>& levels) {
  Outputs outputs = {{"-o", levels.front().output},
                     {"--limit-mesh", arguments.limit_output},
                     {"--displace", arguments.displacement},
                     {"--rebuild", arguments.rebuilt},
                     {"--csv", arguments.csv},
                     {"--json", arguments.json}};
  for (const ImageRequest& request : images_asked_for(arguments)) {
    outputs.emplace_back("the image of " + request.what, request.path);
  }
  const bool one_file = kind_of(arguments.output) == ".glb";
  for (size_t level = 1; level < levels.size() && !one_file; ++level) {
    outputs.emplace_back("--lods", levels[level].output);
  }
  std::vector<std::string> inputs = {arguments.input, arguments.sphere};
  if (arguments.grid.starts_with(like_prefix))
    inputs.push_back(arguments.grid.substr(like_prefix.size()));
  check_places(inputs, outputs);
}

/// What makes no sense is refused before work. The grid asked for, where it is none of a file.
std::optional<GridSpec> check_arguments(const RemeshArguments& arguments) {
  check_outputs(arguments);
  std::optional<GridSpec> spec = grid_asked_for(arguments);
  check_images(arguments, spec);
  check_subdivision(arguments, spec);
  check_displacement(arguments);
  return spec;
}

SphereGrid grid_for(const RemeshArguments& arguments, const std::optional<GridSpec>& spec) {
  if (spec) return make_grid(*spec, {.threads = arguments.threads});
  return read_like_grid(arguments.grid.substr(like_prefix.size()), arguments.threads);
}

std::vector<std::string> words_of(const std::string& list) { return CLI::detail::split(list, ','); }

Remeshed remesh_source(const MappedMesh& mapped, SphereGrid grid,
                       const RemeshArguments& arguments, Console& console) {
  try {
    return remesh(
        mapped.file(), mapped.map(), std::move(grid),
        {.sample = arguments.sample,
         .transfer = words_of(arguments.transfer),
         .threads = arguments.threads,
         .progress = [&](std::string_view stage, double f) { return console.progress(stage, f); }});
  } catch (const std::invalid_argument& error) {
    throw UsageMistake("--transfer: " + std::string(error.what()));
  }
}

Provenance provenance(const RemeshArguments& arguments, const MappedMesh& mapped) {
  Provenance lines = {{"version", version},
                      {"method", "remesh"},
                      {"grid", std::filesystem::path(arguments.grid).filename().string()},
                      {"sample", arguments.sample == SampleMode::Cell ? "cell" : "point"}};
  for (const auto& [key, value] : mapped.provenance()) {
    if (key == "method") lines.emplace_back("source", value);
  }
  if (arguments.adaptive) lines.emplace_back("options", "--adaptive");
  if (arguments.subdivision) lines.emplace_back("subdivision", name_of(*arguments.subdivision));
  lines.emplace_back("verdict", "one-to-one");
  return lines;
}

void add_mesh(PendingFiles& files, const std::string& path, const RemeshArguments& arguments,
              const MappedMesh& mapped, const Remeshed& result) {
  MeshFile file = attach_map(result.file, result.map, provenance(arguments, mapped));
  const Topology topology(result.file.mesh, arguments.threads);
  add_mapped(files, path, std::move(file), result.faces, topology, arguments.threads);
}

void add_meshes(PendingFiles& files, const std::vector<RemeshLevel>& levels,
                const MappedMesh& mapped, Console& console) {
  const RemeshArguments& arguments = levels.front().arguments;
  if (arguments.output.empty()) return;
  if (kind_of(arguments.output) == ".glb") {
    add_glb(files, arguments, mapped, levels, provenance(arguments, mapped), console);
    return;
  }
  for (const RemeshLevel& level : levels)
    add_mesh(files, level.arguments.output, level.arguments, mapped, level.mesh);
}

RemeshLevel make_level(const MappedMesh& mapped, SphereGrid grid,
                       const RemeshArguments& arguments, Console& console) {
  RemeshLevel level{arguments, remesh_source(mapped, std::move(grid), arguments, console)};
  if (arguments.subdivision) {
    const TriangleMesh flat = level.mesh.file.mesh;
    level.fit = fit_subdivision(mapped, level.mesh, arguments, console);
    compare_with_flat(level, flat, mapped, console);
  }
  console.progress("certify", 0);
  const Remeshed& mesh = level.mesh;
  require_certified(
      certify(Topology(mesh.file.mesh, arguments.threads), mesh.map, arguments.threads),
      arguments.grid);
  if (interrupted()) throw Cancelled();
  return level;
}

/// The meshes asked for, finest first, the first one on the grid given.
std::vector<RemeshLevel> make_levels(const MappedMesh& mapped, SphereGrid grid,
                                     const std::vector<RemeshArguments>& asked, Console& console) {
  std::vector<RemeshLevel> levels = {make_level(mapped, std::move(grid), asked.front(), console)};
  for (size_t level = 1; level < asked.size(); ++level) {
    SphereGrid coarse = make_grid(parse_grid(asked[level].grid), {.threads = asked[level].threads});
    levels.push_back(make_level(mapped, std::move(coarse), asked[level], console));
  }
  if (levels.size() > 1) measure_levels(levels, mapped, console);
  return levels;
}

std::optional<DisplacementReport> add_outputs(PendingFiles& files, const RemeshArguments& arguments,
                                              const std::optional<GridSpec>& spec,
                                              const MappedMesh& mapped,
                                              const std::vector<RemeshLevel>& levels,
                                              Console& console) {
  const Remeshed& result = levels.front().mesh;
  const std::optional<SubdivisionFit>& fit = levels.front().fit;
  console.progress("write", 0);
  add_meshes(files, levels, mapped, console);
  if (!arguments.limit_output.empty()) {
    add_mesh(files, arguments.limit_output, arguments, mapped,
             limit_mesh(result, *fit, arguments.threads));
  }
  std::optional<DisplacementReport> displacement;
  if (!arguments.displacement.empty())
    displacement = add_displacement(files, arguments, mapped, result, *fit, console);
  if (spec) add_images(files, arguments, *spec, result);
  if (!arguments.csv.empty()) files.add(arguments.csv, sample_table(result.file, result.map));
  return displacement;
}

void tell(const RemeshReport& report, Console& console) {
  const RemeshArguments& arguments = report.arguments;
  const Remeshed& result = report.result;
  const TriangleMesh& source = report.source.file().mesh;
  console.detail("  grid: " + short_number(report.grid_seconds) +
                 " s, location: " + short_number(result.locate_seconds) +
                 " s, positions: " + short_number(result.transfer_seconds) + " s");
  if (arguments.sample == SampleMode::Cell) {
    console.detail("  means over cells at " + std::to_string(result.averaged) + " of " +
                   std::to_string(result.map.points.rows()) + " vertices");
  }
  if (report.fit) console.say(fit_line(*report.fit, source));
  if (report.displacement) console.say(displacement_lines(*report.displacement, source));
  if (report.levels.size() > 1) console.say(level_lines(report.levels, source));
  std::string line = display_name(arguments.input) + ": " + arguments.grid + ", " +
                     std::to_string(result.map.points.rows()) +
                     " vertices, certified one-to-one, " + short_number(report.seconds) + " s";
  if (!arguments.output.empty())
    line += " → " + output_name(report.levels.front().arguments.output);
  console.say(line);
}

int run_remesh(const RemeshArguments& arguments) {
  const Stopwatch stopwatch;
  const std::optional<GridSpec> spec = check_arguments(arguments);
  const std::vector<RemeshArguments> asked = levels_asked_for(arguments, spec);
  check_all_places(arguments, asked);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const OrderlyInterruption orderly;
  MappedMesh mapped = read_mapped_source(arguments.input, arguments.sphere, arguments.threads,
                                           console, remeshing_lambda);
  if (arguments.subdivision || arguments.lods > 0) require_measurable(mapped.file().mesh);
  console.progress("grid", 0);
  const Stopwatch grid_stopwatch;
  SphereGrid grid = grid_for(arguments, spec);
  const double grid_seconds = grid_stopwatch.seconds();
  std::optional<Adaptation> adaptation;
  if (arguments.adaptive)
    adaptation = adapt_source(mapped, grid.directions.rows(), arguments, console);
  const std::vector<RemeshLevel> levels = make_levels(mapped, std::move(grid), asked, console);
  PendingFiles files;
  const std::optional<DisplacementReport> displacement =
      add_outputs(files, arguments, spec, mapped, levels, console);
  RemeshReport report{.arguments = arguments,
                      .source = mapped,
                      .result = levels.front().mesh,
                      .adaptation = std::move(adaptation),
                      .fit = levels.front().fit,
                      .displacement = displacement,
                      .levels = levels,
                      .grid_seconds = grid_seconds,
                      .seconds = stopwatch.seconds()};
  if (!arguments.json.empty()) files.add(arguments.json, to_json(report));
  if (interrupted()) throw Cancelled();
  files.publish();
  report.seconds = stopwatch.seconds();
  console.clear_progress();
  tell(report, console);
  return Ok;
}

}  // namespace

Command declare_remesh(CLI::App& program) {
  const auto arguments = std::make_shared<RemeshArguments>();
  CLI::App* command = declare_remesh_arguments(program, *arguments);
  return {command, [arguments] { return run_remesh(*arguments); }};
}

}  // namespace sphparam::cli
