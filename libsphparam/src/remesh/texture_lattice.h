#pragma once

#include <array>
#include <vector>

#include "remesh/grids/grid_chart.h"
#include "sphparam/remesh/limit_surface.h"
#include "sphparam/remesh/texture_layout.h"

namespace sphparam {

/// In texels from the top left; the middles of texels are whole numbers.
using TexelPoint = Eigen::Vector2d;

/// The faces of a grid in an image, both ways.
class TextureLattice {
 public:
  /// Requires: as `with_grid_texture`.
  TextureLattice(const GridSpec& spec, const SphereGrid& grid, const TextureLayout& layout);

  const TextureLayout& layout() const { return layout_; }
  /// Whether the image goes on at its left side where it ends at its right one.
  bool closed() const { return cells_.closed; }

  /// Where a corner of the list of the grid's faces is.
  TexelPoint corner(int index) const;
  /// Texture coordinates of a point, v upwards.
  Eigen::Vector2d coordinates(const TexelPoint& point) const;

  /// A place on a face: corner 0 is at (s, t) = (0, 0), corner 1 at (1, 0), the last one at (0, 1).
  TexelPoint point(const LimitPlace& on_face) const;
  /// The place on a face that the middle of a texel shows. In a gutter: beyond the side of a face
  /// at the border of the tile, or at its corner; beside the triangles at a pole: on their nearest
  /// side.
  LimitPlace place(int column, int row) const;

 private:
  struct InTile {
    int tile;
    TexelPoint at, inside;  // cells; within the tile
  };
  InTile in_tile(int column, int row) const;
  int face_at(int tile, const TexelPoint& cells) const;
  LimitPlace on_face(int face, const TexelPoint& cells) const;
  TexelPoint cells(int index) const;

  ChartCells cells_;
  std::vector<ChartCorner> corners_;  // of the faces
  TextureLayout layout_;
  std::vector<int> starts_;                // where each begins in them
  std::vector<std::array<int, 2>> faces_;  // of a cell, tile after tile, row by row; −1: none
};

}  // namespace sphparam
