#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "remesh/grids/grid_chart.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

struct ImageSize {
  int width, height;
};

/// Which vertex of a grid is at each sample of a square image: the grid cut open and laid flat.
/// Samples on the cut occur twice or more, and name the same vertex.
struct ImageLayout {
  int width, height;
  std::vector<int> vertex;  // of sample row·width + column; −1 as long as there is none

  explicit ImageLayout(const ImageSize& size);
  void put(long column, long row, int v) {
    vertex[static_cast<std::size_t>(row * width + column)] = v;
  }
};

/// All there is to know of a family of grids. A new one: its file, with such a table in it; its
/// name in `GridKind`; its name below; its line in grid_families.cpp.
struct GridFamily {
  GridKind kind;
  const char* prefix;       // of its names: "octa:"
  const char* pattern;      // of its names, for people: "octa:N"
  const char* sizes;        // what may stand there, and an example, for people
  bool has_height = false;  // "WxH" rather than "N"
  bool has_quads = false;   // among its faces

  bool (*is_size)(const GridSpec& spec);
  /// Requires: a size of at most 2²⁴ where there is no height, so that its square can be counted.
  std::int64_t (*vertex_count)(const GridSpec& spec);
  /// Ensures: as `make_grid`.
  SphereGrid (*make)(const GridSpec& spec, const GridOptions& options);
  /// As `coarser_grid`; null where the grids of a family are not halved.
  std::optional<GridSpec> (*coarser)(const GridSpec& spec, int halvings) = nullptr;
  /// The grid as an image, and how large that is; null where it cannot be one. `directions`: its
  /// own.
  ImageLayout (*image)(const GridSpec& spec, const Points& directions) = nullptr;
  ImageSize (*image_size)(const GridSpec& spec) = nullptr;
  /// The layout of the faces in an image, and where each of their corners is in it; null where a
  /// family has none. `grid`: its own, without ancestry.
  ChartCells (*chart_cells)(const GridSpec& spec) = nullptr;
  std::vector<ChartCorner> (*chart)(const GridSpec& spec, const SphereGrid& grid) = nullptr;
};

extern const GridFamily icosahedron_family, cut_icosahedron_family, octahedron_family, cube_family,
    geographic_family, healpix_family;

/// All of them, in the order in which people are told of them.
std::span<const GridFamily* const> grid_families();

/// The family of a kind. Throws: std::invalid_argument for one that is not listed.
const GridFamily& family_of(GridKind kind);

/// Throws: std::invalid_argument, naming the grid, for a kind or a size that there is not, and for
/// more than `most_grid_vertices`.
void require_grid(const GridSpec& spec);

}  // namespace sphparam
