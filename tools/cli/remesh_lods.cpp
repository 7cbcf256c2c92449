// What is measured of a fitted level is its limit surface, cut fine; of a plain one its triangles.

#include "cli/remesh_lods.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cli/choice.h"
#include "cli/exit_codes.h"
#include "cli/level_path.h"
#include "cli/paths.h"
#include "cli/wording.h"
#include "measure/surface_distance.h"
#include "remesh/lods.h"
#include "remesh/patch_net.h"

namespace sphparam::tools {

namespace {

constexpr int most_levels = 12;
constexpr std::int64_t distance_samples = 250'000;  // on each side
constexpr std::int64_t comparing_samples = 50'000;
constexpr std::int64_t pieces_of_limit_surface = 250'000;  // that is measured

/// The triangles that a level shows: of its limit surface, where there is one.
TriangleMesh shown(const RemeshLevel& level) {
  if (!level.fit) return level.mesh.file.mesh;
  const SubdivisionFit& fit = *level.fit;
  ControlMesh control{level.mesh.faces, {fit.control}};
  if (fit.topology->patch_count() != level.mesh.faces.count())
    control = subdivide_to_quads(control);
  int cuts = 2;
  while (cuts * cuts * control.faces.count() < pieces_of_limit_surface) ++cuts;
  const Tessellation fine =
      tessellate(control.faces, static_cast<int>(control.points[0].rows()), cuts);
  const auto points = LimitSurface(control.faces, control.points[0], fit.topology->scheme())
                          .evaluate_all(fine.vertices, level.arguments.threads);
  TriangleMesh mesh;
  mesh.positions.resize(std::ssize(points), 3);
  for (size_t v = 0; v < points.size(); ++v)
    mesh.positions.row(static_cast<Eigen::Index>(v)) = points[v].position;
  mesh.triangles = triangulate(mesh.positions, fine.faces).triangles;
  return mesh;
}

}  // namespace

void declare_lod_options(CLI::App& command, RemeshArguments& arguments) {
  command
      .add_option(
          "--lods", arguments.lods,
          "So many coarser meshes, each on the grid's coarser half, with the error of each: "
          "files of their own, NAME_lod1 …, or levels (MSFT_lod) of one .glb")
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
          (level == 1 ? " has no coarser grids: ico:L, and octa:N and cube:N by powers of two, have"
                      : " has only " + std::to_string(level - 1) + " coarser"));
    }
    levels.push_back(arguments);
    levels.back().grid = name_of(*coarse);
    if (!one_file) levels.back().output = level_path(arguments.output, level);
  }
  for (const RemeshArguments& level : levels) {
    require_not_input(arguments.input, level.output, "--lods");
    if (!arguments.sphere.empty()) require_not_input(arguments.sphere, level.output, "--lods");
  }
  return levels;
}

void compare_with_flat(RemeshLevel& level, const TriangleMesh& flat, const MappedSource& mapped,
                       Console& console) {
  const auto rms = [&](const TriangleMesh& mesh) {
    return measure_distance(mapped.source.file.mesh, mesh,
                            {.samples = comparing_samples, .threads = level.arguments.threads})
        .rms();
  };
  SubdivisionFit& fit = level.fit.value();
  fit.two_sided_rms = rms(shown(level));
  fit.flat_rms = rms(flat);
  if (fit.two_sided_rms < fit.flat_rms) return;
  console.warning(level.arguments.grid +
                  " is too coarse for a smooth surface: flat faces on it are nearer to the mesh "
                  "than what was fitted");
}

void measure_levels(std::vector<RemeshLevel>& levels, const MappedSource& mapped,
                    Console& console) {
  for (RemeshLevel& level : levels) {
    const SurfaceDistance distance = measure_distance(
        mapped.source.file.mesh, shown(level),
        {.samples = distance_samples,
         .threads = level.arguments.threads,
         .progress = [&](std::string_view stage, double f) { return console.progress(stage, f); }});
    level.rms = distance.rms();
    level.max = distance.max();
  }
}

std::string level_lines(const std::vector<RemeshLevel>& levels, const TriangleMesh& source) {
  const double diagonal =
      (source.positions.colwise().maxCoeff() - source.positions.colwise().minCoeff()).norm();
  const auto percent = [&](double length) { return short_number(100 / diagonal * length) + " %"; };
  std::string lines;
  for (const RemeshLevel& level : levels) {
    lines.append(lines.empty() ? "  " : "\n  ")
        .append(level.arguments.grid)
        .append(", ")
        .append(std::to_string(level.mesh.map.points.rows()))
        .append(" vertices: RMS ")
        .append(percent(level.rms))
        .append(", at most ")
        .append(percent(level.max))
        .append(" of the diagonal → ")
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

}  // namespace sphparam::tools
