// uv:WxH: the meridians and rows of a map of longitude and latitude.

#include <numbers>

#include "remesh/grids/grid_family.h"
#include "remesh/grids/grid_parts.h"
#include "sphparam/sphere/spherical_coordinates.h"

namespace sphparam {

namespace {

std::int64_t vertices(const GridSpec& spec) {
  return std::int64_t{spec.size} * (spec.height - 1) + 2;
}

/// W meridians and H rows of cells: the north pole, rows of W vertices, the south pole.
SphereGrid make(const GridSpec& spec, const GridOptions& /*options*/) {
  const int width = spec.size, height = spec.height;
  SphereGrid grid;
  const int south = width * (height - 1) + 1;
  grid.directions.resize(south + 1, 3);
  grid.directions.row(0) = Vector3::UnitZ();
  grid.directions.row(south) = -Vector3::UnitZ();
  const auto at = [&](int column, int row) {
    if (row == 0) return 0;
    return row == height ? south : 1 + (row - 1) * width + column % width;
  };
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const int a = at(column, row), b = at(column, row + 1), c = at(column + 1, row + 1),
                d = at(column + 1, row);
      if (row > 0) {
        grid.directions.row(a) =
            to_cartesian({2 * std::numbers::pi * column / width, std::numbers::pi * row / height});
      }
      if (row == 0) {
        add_face(grid.faces, {a, b, c});
      } else if (row == height - 1) {
        add_face(grid.faces, {a, b, d});
      } else {
        add_face(grid.faces, {a, b, c, d});
      }
    }
  }
  return grid;
}

ChartCells chart_cells(const GridSpec& spec) {
  return {.columns = 1, .rows = 1, .width = spec.size, .height = spec.height, .closed = true};
}

/// The corners of `make`, in its order; a pole is in the middle of each of its triangles.
std::vector<ChartCorner> chart(const GridSpec& spec, const SphereGrid& /*grid*/) {
  std::vector<ChartCorner> corners;
  for (int row = 0; row < spec.height; ++row) {
    for (int column = 0; column < spec.size; ++column) {
      const double left = column, right = column + 1, top = row, bottom = row + 1,
                   middle = column + 0.5;
      if (row == 0) {
        corners.insert(corners.end(), {{0, middle, top}, {0, left, bottom}, {0, right, bottom}});
      } else if (row == spec.height - 1) {
        corners.insert(corners.end(), {{0, left, top}, {0, middle, bottom}, {0, right, top}});
      } else {
        corners.insert(corners.end(),
                       {{0, left, top}, {0, left, bottom}, {0, right, bottom}, {0, right, top}});
      }
    }
  }
  return corners;
}

}  // namespace

const GridFamily geographic_family = {
    .kind = GridKind::Geographic,
    .prefix = "uv:",
    .pattern = "uv:WxH",
    .sizes = "W from 3 and H from 2, as in uv:512x256",
    .has_height = true,
    .has_quads = true,
    .is_size = [](const GridSpec& spec) { return spec.size >= 3 && spec.height >= 2; },
    .vertex_count = vertices,
    .make = make,
    .chart_cells = chart_cells,
    .chart = chart};

}  // namespace sphparam
