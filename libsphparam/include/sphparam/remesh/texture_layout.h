#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

// The layout of a grid in an image: its faces side by side as they lie on the flat polyhedron, each
// cell of the grid a square of `steps` texels. Coordinates that are interpolated in straight lines
// over a face, as programs do that subdivide, are then right everywhere, which those of an
// equirectangular image are not: directions do not run straight over a face.
//
// cube:N has six tiles of N × N cells in two rows, +x −x +y and −y +z −z, each seen from outside;
// octa:N one tile, the square of the geometry image; ico:L and ico:f=N ten diamonds in two rows,
// those at the north pole above those at the south pole. A vertex of the grid lies on the middle of
// a texel, and so does each vertex of `levels` subdivisions. About a tile is a rim of `gutter`
// texels that go on beyond the cut, so that what is blurred across it stays right. uv:WxH is the
// equirectangular chart itself, u = θ/2π and v = 1 − ϕ/π, without a rim; each triangle at a pole
// has its tip in the middle of its column.

struct TextureLayout {
  int width = 0, height = 0;  // of the image
  int columns = 1, rows = 1;  // of tiles
  int levels = 0, steps = 1;  // 2^levels texels from one vertex of the grid to the next
  int gutter = 0;             // texels about a tile

  bool operator==(const TextureLayout&) const = default;
};

/// Whether a grid has such a layout: all but healpix:NSIDE have.
bool has_texture_layout(const GridSpec& spec);

/// The finest layout that has no more texels, or that of a texel a vertex where even this has more.
/// Throws: std::invalid_argument unless there is such a grid and has_texture_layout(spec).
TextureLayout texture_layout(const GridSpec& spec, std::int64_t texels);

/// The mesh with texture coordinates in the layout of its grid, v upwards; those that it carried
/// are gone. A comment says how they lie; `comments` follow it.
/// Requires: `layout` of this spec. Throws: std::invalid_argument for a grid that has none.
/// Ensures: all faces of the layout are counter-clockwise, no two overlap.
Remeshed with_grid_texture(const Remeshed& mesh, const TextureLayout& layout, int threads = 0,
                           const std::vector<std::string>& comments = {});

}  // namespace sphparam
