// ico:L, halved on the sphere as geodesic grids are, and ico:f=N, cut flat as class I domes are.

#include <algorithm>

#include "remesh/grids/grid_family.h"
#include "remesh/grids/grid_parts.h"
#include "remesh/grids/lattice_grid.h"

namespace sphparam {

namespace {

std::int64_t halved_vertices(const GridSpec& spec) {
  const int levels = std::min(spec.size, 24);  // more are too many in any case
  return 10 * (std::int64_t{1} << 2 * levels) + 2;
}

SphereGrid make_halved(const GridSpec& spec, const GridOptions& options) {
  return subdivide(icosahedron(), spec.size, Placement::Halved, options);
}

std::optional<GridSpec> coarser_halved(const GridSpec& spec, int halvings) {
  if (spec.size < halvings) return std::nullopt;
  return GridSpec{spec.kind, spec.size - halvings, 0};
}

std::int64_t cut_vertices(const GridSpec& spec) {
  return 10 * std::int64_t{spec.size} * spec.size + 2;
}

SphereGrid make_cut(const GridSpec& spec, const GridOptions& options) {
  SphereGrid grid = cut_triangles(icosahedron(), spec.size);
  place_all(grid, options.threads, [](const Vector3& flat) { return flat; });
  return grid;
}

ChartCells chart_cells(const GridSpec& spec) {
  const int n = spec.kind == GridKind::Icosahedron ? 1 << spec.size : spec.size;
  return {5, 2, n, n};
}

/// By the same grid as it lies on the flat icosahedron.
std::vector<ChartCorner> chart_halved(const GridSpec& spec, const SphereGrid& grid) {
  const SphereGrid flat = subdivide(icosahedron(), spec.size, Placement::Flat, {});
  return corners_on_diamonds(1 << spec.size, flat.directions, grid.faces);
}

std::vector<ChartCorner> chart_cut(const GridSpec& spec, const SphereGrid& grid) {
  return corners_on_diamonds(spec.size, grid.directions, grid.faces);
}

}  // namespace

const GridFamily icosahedron_family = {
    .kind = GridKind::Icosahedron,
    .prefix = "ico:",
    .pattern = "ico:L",
    .sizes = "L from 0, as in ico:7",
    .is_size = [](const GridSpec& spec) { return spec.size >= 0; },
    .vertex_count = halved_vertices,
    .make = make_halved,
    .coarser = coarser_halved,
    .chart_cells = chart_cells,
    .chart = chart_halved};

const GridFamily cut_icosahedron_family = {
    .kind = GridKind::IcosahedronCut,
    .prefix = "ico:f=",
    .pattern = "ico:f=N",
    .sizes = "N from 1, as in ico:f=37",
    .is_size = [](const GridSpec& spec) { return spec.size >= 1; },
    .vertex_count = cut_vertices,
    .make = make_cut,
    .chart_cells = chart_cells,
    .chart = chart_cut};

}  // namespace sphparam
