// Levels are sampled from the source one by one, and measured by what they show.

#include "sphparam/remesh/levels_of_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "number_text.h"
#include "option_domain.h"
#include "remesh/distance_on_grid.h"
#include "remesh/shown_limit.h"
#include "sphparam/measure/measurable.h"

namespace sphparam {

namespace {

void require_domain(const MappedMesh& source, const LevelOptions& options) {
  if (options.subdivision)
    require_one_of("subdivision", *options.subdivision, Scheme::CatmullClark);
  if (options.measure) require_measurable(source.mesh());
}

void fit_level(LevelOfDetail& level, const MappedMesh& source, const LevelOptions& options) {
  const SubdivisionFitOptions fitting{.scheme = options.subdivision.value(),
                                      .threads = options.threads,
                                      .progress = options.progress};
  SubdivisionFit fit = fit_subdivision(source, level.mesh.grid(), fitting);
  compare_with_flat(fit, source, level.mesh, fitting);
  level.mesh = control_mesh(level.mesh, fit, options.threads);
  level.fit = std::move(fit);
}

/// The areas of a grid are the first one's.
LevelOfDetail make_level(const MappedMesh& source, SphereGrid grid, const LevelOptions& options,
                         bool is_first) {
  LevelOfDetail level{remesh(source, std::move(grid),
                             {.sample = options.sample,
                              .source_areas = options.source_areas,
                              .grid_areas = is_first ? options.grid_areas : VectorX(),
                              .transfer = options.transfer,
                              .threads = options.threads,
                              .progress = options.progress})};
  if (options.subdivision)
    fit_level(level, source, options);
  else if (options.look_into_space)
    level.in_space = faces_in_space(
        source, level.mesh,
        {.most_looks = usual_looks, .threads = options.threads, .progress = options.progress});
  return level;
}

LevelOfDetail::Distance distance_between(const TriangleMesh& source, const TriangleMesh& shown,
                                         const std::string& grid, const DistanceOptions& options) {
  const SurfaceDistance distance = distance_on_grid(source, shown, grid, options);
  return {distance.rms(), distance.max()};
}

void measure(LevelOfDetail& level, const MappedMesh& source, const LevelOptions& options) {
  // A fit has no holes.
  const TriangleMesh& from = level.fit ? source.mesh() : source.surface();
  const TriangleMesh shown = level.fit ? shown_mesh(level, options.threads) : level.mesh.surface();
  level.distance = distance_between(from, shown, level.mesh.name(),
                                    {.samples = distance_samples(level.mesh.faces().count()),
                                     .threads = options.threads,
                                     .progress = options.progress});
}

/// As far as a quick look goes where that is more than wanted; else as far as all are apart.
double deviation(const MappedMesh& source, const MappedMesh& made, double most,
                 const LevelOptions& options) {
  constexpr std::int64_t few = 10'000;
  DistanceOptions measuring{
      .samples = few, .extremes = false, .threads = options.threads, .progress = options.progress};
  const auto far = [&] {
    return distance_between(source.surface(), made.surface(), made.name(), measuring).max;
  };
  if (const double seen = far(); seen > most) return seen;
  measuring.samples = DistanceOptions{}.samples;
  measuring.extremes = true;
  return far();
}

void add_levels(std::vector<LevelOfDetail>& levels, const MappedMesh& source,
                std::span<const GridSpec> grids, const LevelOptions& options) {
  for (const GridSpec& grid : grids) {
    report(options.progress, "level " + std::to_string(levels.size()), 0);
    levels.push_back(
        make_level(source, make_grid(grid, {.threads = options.threads}), options, levels.empty()));
  }
  if (!options.measure) return;
  for (LevelOfDetail& level : levels) measure(level, source, options);
}

}  // namespace

std::vector<LevelOfDetail> levels_of_detail(const MappedMesh& source,
                                            std::span<const GridSpec> grids,
                                            const LevelOptions& options) {
  require_domain(source, options);
  std::vector<LevelOfDetail> levels;
  add_levels(levels, source, grids, options);
  return levels;
}

std::vector<LevelOfDetail> levels_of_detail(const MappedMesh& source, SphereGrid finest,
                                            std::span<const GridSpec> coarser,
                                            const LevelOptions& options) {
  require_domain(source, options);
  std::vector<LevelOfDetail> levels;
  levels.push_back(make_level(source, std::move(finest), options, true));
  add_levels(levels, source, coarser, options);
  return levels;
}

std::vector<GridSpec> coarser_grids(const GridSpec& finest, int count) {
  std::vector<GridSpec> grids;
  for (int halvings = 1; halvings <= count; ++halvings) {
    const std::optional<GridSpec> grid = coarser_grid(finest, halvings);
    if (!grid) break;
    grids.push_back(*grid);
  }
  return grids;
}

std::vector<MappedMesh> quartered_meshes(const MappedMesh& source, int count,
                                         const LevelOptions& options) {
  const Eigen::Index finest = source.mesh().vertex_count();
  LevelOptions unfitted = options;
  unfitted.subdivision = {};
  unfitted.look_into_space = false;
  std::vector<MappedMesh> meshes;
  for (int level = 1; level <= count; ++level) {
    // An icosahedron whose edges are cut into N has 10·N² + 2 vertices.
    const double vertices = std::ldexp(static_cast<double>(finest), -2 * level);
    const int size = std::max(1, static_cast<int>(std::lround(std::sqrt(vertices / 10))));
    const Eigen::Index before = meshes.empty() ? finest : meshes.back().mesh().vertex_count();
    if (10 * Eigen::Index{size} * size + 2 >= before) break;
    report(options.progress, "level " + std::to_string(level - 1), 0);
    const SphereGrid grid =
        make_grid({GridKind::IcosahedronCut, size, 0}, {.threads = options.threads});
    const MappedMesh mesh = make_level(source, grid, unfitted, false).mesh;
    meshes.emplace_back(MappedMesh::Parts{.file = mesh.file(),
                                          .map = mesh.map(),
                                          .provenance = source.provenance(),
                                          .topology = mesh.topology(),
                                          .name = source.name()},
                        options.threads);
  }
  return meshes;
}

LevelOfDetail::Distance distance_of_level(const MappedMesh& source, const MappedMesh& level,
                                          int threads, const Progress& progress) {
  require_measurable(source.mesh());
  const Face faces = level.mesh().face_count();
  return distance_between(
      source.surface(), level.surface(), counted(faces, "triangle"),
      {.samples = distance_samples(faces), .threads = threads, .progress = progress});
}

GridWithin coarsest_grid_within(const MappedMesh& source, double most,
                                const LevelOptions& options) {
  require_at_least("most", most, 0);
  require_measurable(source.mesh());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  GridWithin found{.most = most, .max = infinity};
  for (int level = 0; level <= finest_sought; ++level) {
    found.grid = {.kind = GridKind::Icosahedron, .size = level};
    const Remeshed made = remesh(source, found.grid,
                                 {.sample = options.sample,
                                  .transfer = {},
                                  .threads = options.threads,
                                  .progress = options.progress});
    if (made.surface().face_count() == 0) continue;  // holes alone
    const bool is_last = level == finest_sought;  // which is told however far it is
    found.max = deviation(source, made, is_last ? infinity : most, options);
    if (found.holds()) break;
  }
  return found;
}

TriangleMesh shown_mesh(const LevelOfDetail& level, int threads) {
  if (!level.fit) return level.mesh.mesh();
  return fine_limit_mesh(*level.fit, level.mesh.faces(), shown_pieces(level.mesh.faces()), threads);
}

}  // namespace sphparam
