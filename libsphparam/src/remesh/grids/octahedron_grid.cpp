// octa:N: the flat octahedron, (N − 1)/2 pieces an edge; cut open it is a square image of N×N
// samples.

#include <cmath>

#include "remesh/grids/grid_family.h"
#include "remesh/grids/grid_parts.h"
#include "remesh/grids/lattice_grid.h"

namespace sphparam {

namespace {

int pieces(const GridSpec& spec) { return (spec.size - 1) / 2; }

std::int64_t vertices(const GridSpec& spec) {
  return (std::int64_t{spec.size} - 1) * (spec.size - 1) + 2;
}

SphereGrid make(const GridSpec& spec, const GridOptions& options) {
  const std::optional<int> levels = exponent_of_two(pieces(spec));
  SphereGrid grid = levels ? subdivide(octahedron(), *levels, Placement::Flat, options)
                           : cut_triangles(octahedron(), pieces(spec));
  place_all(grid, options.threads, [](const Vector3& flat) { return flat; });
  return grid;
}

std::optional<GridSpec> coarser(const GridSpec& spec, int halvings) {
  const std::optional<int> edges = halved(pieces(spec), halvings);
  return edges ? std::optional(GridSpec{spec.kind, 2 * *edges + 1, 0}) : std::nullopt;
}

ImageSize image_size(const GridSpec& spec) { return {spec.size, spec.size}; }

/// Signs to unfold a coordinate with: both where it is zero.
std::vector<long> signs_of(long x) {
  if (x == 0) return {-1, 1};
  return {x < 0 ? -1L : 1L};
}

/// The northern half is the square turned by 45° in the middle, x to the right and y upwards; the
/// southern half is folded out to the corners, which are −z. The directions are lattice points of
/// the flat octahedron, to which they are scaled back and rounded.
ImageLayout image(const GridSpec& spec, const Points& directions) {
  const long m = pieces(spec);
  ImageLayout layout(image_size(spec));
  for (Eigen::Index v = 0; v < directions.rows(); ++v) {
    const Vector3 flat = directions.row(v) / directions.row(v).lpNorm<1>() * static_cast<double>(m);
    const long x = std::lround(flat.x()), y = std::lround(flat.y());
    const bool south = std::abs(x) + std::abs(y) < m && flat.z() < 0;
    if (!south) {
      layout.put(m + x, m - y, static_cast<int>(v));
      continue;
    }
    for (const long right : signs_of(x)) {
      for (const long up : signs_of(y)) {
        layout.put(m + right * (m - std::abs(y)), m - up * (m - std::abs(x)), static_cast<int>(v));
      }
    }
  }
  return layout;
}

ChartCells chart_cells(const GridSpec& spec) { return {1, 1, spec.size - 1, spec.size - 1}; }

/// The same square; a corner in the southern half is unfolded to the side that its face lies on.
std::vector<ChartCorner> chart(const GridSpec& spec, const SphereGrid& grid) {
  const double m = pieces(spec);
  const auto flat = [&](int v) -> Vector3 {
    const Vector3 q = grid.directions.row(v);
    return (q / q.lpNorm<1>() * m).array().round();
  };
  std::vector<ChartCorner> corners;
  corners.reserve(grid.faces.corners.size());
  for (std::int64_t f = 0; f < grid.faces.count(); ++f) {
    Vector3 middle = Vector3::Zero();
    for (const int v : grid.faces.polygon(f)) middle += flat(v);
    for (const int v : grid.faces.polygon(f)) {
      Vector3 at = flat(v);
      if (middle.z() < 0)
        at.head(2) = Eigen::Vector2d(std::copysign(m - std::abs(at.y()), middle.x()),
                                     std::copysign(m - std::abs(at.x()), middle.y()));
      corners.push_back({0, m + at.x(), m - at.y()});
    }
  }
  return corners;
}

}  // namespace

const GridFamily octahedron_family = {
    .kind = GridKind::Octahedron,
    .prefix = "octa:",
    .pattern = "octa:N",
    .sizes = "N odd and from 3, as in octa:129",
    .is_size = [](const GridSpec& spec) { return spec.size >= 3 && spec.size % 2 == 1; },
    .vertex_count = vertices,
    .make = make,
    .coarser = coarser,
    .image = image,
    .image_size = image_size,
    .chart_cells = chart_cells,
    .chart = chart};

}  // namespace sphparam
