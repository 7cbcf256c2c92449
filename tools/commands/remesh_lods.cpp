// Levels are measured by what they show.

#include "commands/remesh_lods.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "arguments/choice.h"
#include "commands/diagonal.h"
#include "console/exit_codes.h"
#include "commands/level_path.h"
#include "commands/measurable.h"
#include "console/paths.h"
#include "sphparam/io/paths.h"
#include "remesh/levels_of_detail.h"

namespace sphparam::cli {

namespace {

constexpr int most_levels = 12;
constexpr std::int64_t distance_samples = 250'000;  // on each side

}  // namespace

void declare_lod_options(CLI::App& command, RemeshArguments& arguments) {
  command
      .add_option(
          "--lods", arguments.lods,
          "So many coarser meshes, each on the coarser half of its grid (ico:L; octa:N with N - 1 "
          "and cube:N with N a power of two), with the error of each: files of their own, "
          "NAME_lod1 …, or levels (MSFT_lod) of one .glb")
      ->check(between(0, most_levels, "0 to 12"))
      ->type_name("N")
      ->capture_default_str();
}

std::vector<RemeshArguments> levels_asked_for(const RemeshArguments& arguments,
                                              const std::optional<GridSpec>& grid) {
  std::vector<RemeshArguments> levels = {arguments};
  if (arguments.lods == 0) return levels;
  const bool one_file = extension_of(arguments.output) == ".glb";
  if (arguments.output.empty()) throw UsageMistake("--lods are meshes: give -o");
  if (is_stream(arguments.output)) throw UsageMistake("--lods are files: give -o a name");
  if (!one_file) levels.front().output = level_path(arguments.output, 0);
  for (int level = 1; level <= arguments.lods; ++level) {
    const std::optional<GridSpec> coarse = grid ? coarser_grid(*grid, level) : std::nullopt;
    if (!coarse) {
      throw UsageMistake(
          "--lods: " + arguments.grid +
          (level == 1 ? " has no coarser grids: ico:L has, and octa:N with N - 1 and cube:N with N "
                        "a power of two"
                      : " has only " + std::to_string(level - 1) + " coarser"));
    }
    levels.push_back(arguments);
    levels.back().grid = name_of(*coarse);
    if (!one_file) levels.back().output = level_path(arguments.output, level);
  }
  return levels;
}

void measure_levels(std::vector<RemeshLevel>& levels, const MappedMesh& mapped,
                    Console& console) {
  for (RemeshLevel& level : levels) {
    const SurfaceDistance distance = distance_on_grid(
        mapped.file().mesh, shown_mesh(level), level.arguments.grid,
        {.samples = distance_samples,
         .threads = level.arguments.threads,
         .progress = [&](std::string_view stage, double f) { return console.progress(stage, f); }});
    level.rms = distance.rms();
    level.max = distance.max();
  }
}

std::string level_lines(const std::vector<RemeshLevel>& levels, const TriangleMesh& source) {
  const double diagonal = diagonal_of(source.positions);
  std::string lines;
  for (const RemeshLevel& level : levels) {
    lines.append(lines.empty() ? "  " : "\n  ")
        .append(level.arguments.grid)
        .append(", ")
        .append(std::to_string(level.mesh.map.points.rows()))
        .append(" vertices: RMS ")
        .append(percent_of(diagonal, level.rms))
        .append(", at most ")
        .append(percent_of(diagonal, level.max))
        .append(" of the diagonal, both ways → ")
        .append(output_name(level.arguments.output));
  }
  return lines;
}

nlohmann::ordered_json to_json(const std::vector<RemeshLevel>& levels) {
  auto json = nlohmann::ordered_json::array();
  for (const RemeshLevel& level : levels) {
    json.push_back({{"grid", level.arguments.grid},
                    {"file", level.arguments.output},
                    {"vertices", level.mesh.map.points.rows()},
                    {"faces", level.mesh.faces.count()},
                    {"triangles", level.mesh.file.mesh.face_count()},
                    {"rms", level.rms},
                    {"max", level.max}});
  }
  return json;
}

}  // namespace sphparam::cli
