// `sphparam remesh`: a mapped mesh → a grid of the sphere → the mesh on that grid, whose map the
// grid's directions are. What was written is read back and certified before it gets its name.

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "arguments/input_limits.h"
#include "arguments/remesh_arguments.h"
#include "arguments/remesh_checks.h"
#include "commands/mapped_source.h"
#include "commands/remesh_glb.h"
#include "console/exit_codes.h"
#include "console/interruption.h"
#include "reports/remesh_wording.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/remesh/adaptation.h"
#include "sphparam/remesh/displacement.h"
#include "sphparam/remesh/geometry_image.h"
#include "sphparam/remesh/levels_of_detail.h"
#include "sphparam/stopwatch.h"

namespace sphparam::cli {

namespace {

Progress progress_on(Console& console) {
  return [&console](std::string_view stage, double f) { return console.progress(stage, f); };
}

SphereGrid grid_for(const RemeshArguments& arguments, const RemeshRequests& requests) {
  SphereGrid grid = requests.grid ? make_grid(*requests.grid, {.threads = arguments.threads})
                                  : load_grid(requests.like, input_limits(), arguments.threads);
  grid.name = arguments.grid;
  return grid;
}

Adaptation adapt(const MappedMesh& mapped, std::int64_t samples, const RemeshArguments& arguments,
                 Console& console) {
  Adaptation adapted =
      adapt_map(mapped, samples, {.threads = arguments.threads, .progress = progress_on(console)});
  if (adapted.steps == 0) {
    console.warning(display_name(arguments.input) +
                    ": triangles of the map are too thin to be moved: --adaptive does nothing");
  }
  return adapted;
}

std::vector<LevelOfDetail> make_levels(const MappedMesh& mapped, SphereGrid grid,
                                       const RemeshArguments& arguments,
                                       const RemeshRequests& requests, Console& console) try {
  std::vector<LevelOfDetail> levels =
      levels_of_detail(mapped, std::move(grid), requests.coarser,
                       {.sample = arguments.sample,
                        .transfer = CLI::detail::split(arguments.transfer, ','),
                        .subdivision = arguments.subdivision,
                        .measure = !requests.coarser.empty(),
                        .threads = arguments.threads,
                        .progress = progress_on(console)});
  for (const LevelOfDetail& level : levels) {
    if (!level.fit || !level.fit->flat_is_nearer()) continue;
    console.warning(level.mesh.name() +
                    " is too coarse for a smooth surface: flat faces on it are nearer to the mesh "
                    "than what was fitted");
  }
  return levels;
} catch (const NoSuchProperty& error) {
  throw UsageMistake("--transfer: " + std::string(error.what()));
} catch (const UnfittableGrid& error) {
  throw UsageMistake("--subdiv-fit: " + std::string(error.what()));
}

void add_meshes(PendingFiles& files, const RemeshArguments& arguments,
                const RemeshRequests& requests, const MappedMesh& mapped,
                const std::vector<LevelOfDetail>& levels, Console& console) {
  if (requests.one_file) {
    add_glb(files, arguments, mapped, levels, console);
  } else if (!arguments.output.empty()) {
    for (size_t level = 0; level < levels.size(); ++level)
      add_mapped(files, requests.outputs[level], levels[level].mesh, arguments.threads);
  }
  if (arguments.limit_output.empty()) return;
  const LevelOfDetail& finest = levels.front();
  add_mapped(files, arguments.limit_output,
             limit_mesh(finest.mesh, finest.fit.value(), arguments.threads), arguments.threads);
}

std::optional<WrittenDisplacement> displace(PendingFiles& files, const RemeshArguments& arguments,
                                            const MappedMesh& mapped, const LevelOfDetail& level,
                                            Console& console) try {
  if (arguments.displacement.empty()) return std::nullopt;
  const DisplacementSize size = image_size_named(arguments.displacement_size).value();
  WrittenDisplacement written =
      add_displacement(files, {arguments.displacement, arguments.depth, arguments.rebuilt}, mapped,
                       level.mesh, level.fit.value(),
                       {.width = size.width,
                        .height = size.height,
                        .threads = arguments.threads,
                        .progress = progress_on(console)});
  if (written.proof && written.proof->farther_than_base()) console.warning(farther_warning);
  return written;
} catch (const std::range_error& error) {
  throw UsageMistake("--depth: displacement: " + std::string(error.what()));
}

void add_images(PendingFiles& files, const RemeshArguments& arguments,
                const RemeshRequests& requests, const Remeshed& mesh) {
  for (const auto& [what, path] : requests.images) {
    try {
      add_geometry_image(files, path, mesh, what, arguments.depth);
    } catch (const NoSuchProperty& error) {
      throw UsageMistake("--attribute-image: " + std::string(error.what()));
    } catch (const std::range_error& error) {
      throw UsageMistake("--depth: " + what + ": " + error.what());
    }
  }
}

RemeshOutputs outputs_of(const RemeshArguments& arguments, const RemeshRequests& requests) {
  return {.mesh = arguments.output,
          .limit_mesh = arguments.limit_output,
          .displacement = arguments.displacement,
          .rebuilt = arguments.rebuilt,
          .geometry_image = arguments.geometry_image,
          .normals = arguments.normal_image,
          .csv = arguments.csv,
          .attribute_images = arguments.attribute_images,
          .levels = requests.outputs};
}

int run_remesh(const RemeshArguments& arguments) {
  const Stopwatch stopwatch;
  const RemeshRequests requests = check_remesh_arguments(arguments);
  Console console(arguments.loudness.verbosity(), arguments.progress);
  const OrderlyInterruption orderly;
  MappedMesh mapped = read_mapped_source(arguments.input, arguments.sphere, arguments.threads,
                                         console, remeshing_lambda);
  if (arguments.subdivision || arguments.lods > 0) require_measurable(mapped.mesh());
  console.progress("grid", 0);
  const Stopwatch grid_stopwatch;
  SphereGrid grid = grid_for(arguments, requests);
  const double grid_seconds = grid_stopwatch.seconds();
  std::optional<Adaptation> adaptation;
  if (arguments.adaptive) {
    adaptation = adapt(mapped, grid.directions.rows(), arguments, console);
    mapped = adaptation->mapped;
  }
  const std::vector<LevelOfDetail> levels =
      make_levels(mapped, std::move(grid), arguments, requests, console);
  RemeshRecord record{.input = arguments.input,
                      .grid = arguments.grid,
                      .source = mapped,
                      .levels = levels,
                      .sample = arguments.sample,
                      .adaptation = adaptation,
                      .outputs = outputs_of(arguments, requests),
                      .grid_seconds = grid_seconds};
  console.progress("write", 0);
  PendingFiles files;
  const LevelOfDetail& finest = levels.front();
  add_meshes(files, arguments, requests, mapped, levels, console);
  record.displacement = displace(files, arguments, mapped, finest, console);
  add_images(files, arguments, requests, finest.mesh);
  if (!arguments.csv.empty()) files.add(arguments.csv, sample_table(finest.mesh));
  record.seconds = stopwatch.seconds();
  if (!arguments.json.empty()) files.add(arguments.json, to_json(record));
  if (interrupted()) throw Cancelled();
  files.publish();
  record.seconds = stopwatch.seconds();
  console.clear_progress();
  tell(record, console);
  return Ok;
}

}  // namespace

Command declare_remesh(CLI::App& program) {
  const auto arguments = std::make_shared<RemeshArguments>();
  CLI::App* command = declare_remesh_arguments(program, *arguments);
  return {command, [arguments] { return run_remesh(*arguments); }};
}

}  // namespace sphparam::cli
