// cube:N: quads, N an edge, at equal angles; cut open, six square images below one another.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "elementary.h"
#include "remesh/grids/grid_family.h"
#include "remesh/grids/grid_parts.h"
#include "remesh/grids/lattice_grid.h"

namespace sphparam {

namespace {

std::int64_t vertices(const GridSpec& spec) { return 6 * std::int64_t{spec.size} * spec.size + 2; }

/// Of points of the flat cube: equal steps become equal angles at the middle of a side.
Vector3 equal_angles(const Vector3& flat) {
  const double half = flat.cwiseAbs().maxCoeff();
  return flat.unaryExpr([&](double x) {
    return std::abs(x) == half ? std::copysign(1.0, x)
                               : elementary::tan(std::numbers::pi / 4 * x / half);
  });
}

SphereGrid make(const GridSpec& spec, const GridOptions& options) {
  const std::optional<int> levels = exponent_of_two(spec.size);
  SphereGrid grid =
      levels ? subdivide(cube(), *levels, Placement::Flat, options) : cut_cube(spec.size);
  place_all(grid, options.threads, equal_angles);
  return grid;
}

std::optional<GridSpec> coarser(const GridSpec& spec, int halvings) {
  const std::optional<int> edges = halved(spec.size, halvings);
  return edges ? std::optional(GridSpec{spec.kind, *edges, 0}) : std::nullopt;
}

ImageSize image_size(const GridSpec& spec) { return {spec.size + 1, 6 * (spec.size + 1)}; }

/// Right and up of a side of the cube, seen from outside.
struct Side {
  Vector3 normal, right, up;
};
std::array<Side, 6> sides() {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  return {{{x, y, z}, {-x, -y, z}, {y, -x, z}, {-y, x, z}, {z, y, -x}, {-z, y, x}}};
}

/// Of a tangent from −1 to 1, how many of n equal angles it is from −1.
long steps_to(double tangent, int n) {
  return std::lround((elementary::atan(tangent) / (std::numbers::pi / 4) + 1) / 2 * n);
}

/// Six sides of (N + 1)×(N + 1) samples below one another, +x −x +y −y +z −z, each seen from
/// outside. The directions are lattice points of the flat cube, to which they are turned back.
ImageLayout image(const GridSpec& spec, const Points& directions) {
  const int n = spec.size;
  const auto place = [&](double tangent) { return steps_to(tangent, n); };
  const std::array<Side, 6> all = sides();
  ImageLayout layout(image_size(spec));
  for (Eigen::Index v = 0; v < directions.rows(); ++v) {
    const Vector3 q = directions.row(v);
    const double within_rounding = q.cwiseAbs().maxCoeff() * (1 - 1e-12);
    for (size_t s = 0; s < all.size(); ++s) {
      const double depth = q.dot(all[s].normal);
      if (depth < within_rounding) continue;
      const long column = place(q.dot(all[s].right) / depth), up = place(q.dot(all[s].up) / depth);
      layout.put(column, static_cast<long>(s) * (n + 1) + n - up, static_cast<int>(v));
    }
  }
  return layout;
}

ChartCells chart_cells(const GridSpec& spec) { return {3, 2, spec.size, spec.size}; }

/// A tile for each side, in the order of `sides`.
std::vector<ChartCorner> chart(const GridSpec& spec, const SphereGrid& grid) {
  const std::array<Side, 6> all = sides();
  std::vector<ChartCorner> corners;
  corners.reserve(grid.faces.corners.size());
  for (std::int64_t f = 0; f < grid.faces.count(); ++f) {
    Vector3 middle = Vector3::Zero();
    for (const int v : grid.faces.polygon(f)) middle += grid.directions.row(v);
    const auto faces = [&](const Side& a, const Side& b) {
      return a.normal.dot(middle) < b.normal.dot(middle);
    };
    const auto side = std::max_element(all.begin(), all.end(), faces);
    for (const int v : grid.faces.polygon(f)) {
      const Vector3 q = grid.directions.row(v);
      const double depth = q.dot(side->normal);
      const long right = steps_to(q.dot(side->right) / depth, spec.size),
                 up = steps_to(q.dot(side->up) / depth, spec.size);
      corners.push_back({static_cast<int>(side - all.begin()), static_cast<double>(right),
                         static_cast<double>(spec.size - up)});
    }
  }
  return corners;
}

}  // namespace

const GridFamily cube_family = {.kind = GridKind::Cube,
                                .prefix = "cube:",
                                .pattern = "cube:N",
                                .sizes = "N from 1, as in cube:64",
                                .has_quads = true,
                                .is_size = [](const GridSpec& spec) { return spec.size >= 1; },
                                .vertex_count = vertices,
                                .make = make,
                                .coarser = coarser,
                                .image = image,
                                .image_size = image_size,
                                .chart_cells = chart_cells,
                                .chart = chart};

}  // namespace sphparam
