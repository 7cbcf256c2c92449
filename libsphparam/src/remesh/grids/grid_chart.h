#pragma once

#include <vector>

#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

/// A grid cut open and laid flat on tiles: rectangles of whole cells, side by side in rows. Every
/// cell has one quad in it, or two triangles; of uv:WxH one triangle at a pole.
struct ChartCells {
  int columns, rows;    // of tiles, which are numbered row by row from the top left
  int width, height;    // cells of a tile
  bool closed = false;  // the equirectangular chart: its right side is its left one
};

/// Where a corner of a face is. In cells, from the top left of its tile: x to the right, y
/// downwards.
struct ChartCorner {
  int tile;
  double x, y;
};

/// The ten diamonds of an icosahedron with n cells an edge, five at either pole, in two rows.
/// `flat`: the vertices on the flat icosahedron, of any size; `faces`: of one of its sides after
/// another. Returns a corner for each of the faces'.
std::vector<ChartCorner> corners_on_diamonds(int n, const Points& flat, const Polygons& faces);

}  // namespace sphparam
