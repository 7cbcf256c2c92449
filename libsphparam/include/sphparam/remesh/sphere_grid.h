#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/polygons.h"
#include "sphparam/io/read_options.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

class MappedMesh;

/// The families of grids of the sphere that meshes are resampled on. Another sphere's vertices are
/// a grid too: `load_grid`, `grid_of`.
enum class GridKind {
  Icosahedron,     // ico:L: each edge halved L times, midpoints on the sphere
  IcosahedronCut,  // ico:f=N: each edge of the icosahedron cut into N, as class I domes are
  Octahedron,      // octa:N: the flat octahedron of a square image of N×N samples, N odd
  Cube,            // cube:N: quads, N an edge, at equal angles (tan warp)
  Geographic,      // uv:WxH: W meridians, H rows of cells, a vertex at each pole
  Healpix,         // healpix:NSIDE: pixel centres in RING order (Górski et al. 2005)
};

struct GridSpec {
  GridKind kind = GridKind::Icosahedron;
  int size = 0;    // L, N, W or NSIDE
  int height = 0;  // H of uv:WxH

  bool operator==(const GridSpec&) const = default;
};

/// How grids are named, with commas between: "ico:L, ico:f=N, octa:N, …".
std::string grid_patterns();

/// The grid that "ico:7", "uv:512x256" … names.
/// Throws: std::invalid_argument, saying what was expected, also for more than
/// `most_grid_vertices`.
GridSpec parse_grid(const std::string& text);
/// The inverse.
std::string name_of(const GridSpec& spec);

/// Half-edges are numbered by int, and there are six to a vertex.
constexpr std::int64_t most_grid_vertices = std::int64_t{1} << 28;
std::int64_t vertex_count(const GridSpec& spec);

/// Whether some of its faces are quads; else all are triangles.
bool has_quads(const GridSpec& spec);

/// The grid so many halvings of edges coarser, a quarter of the faces each: its vertices are the
/// first ones of the finer grid's, bit for bit, and the finer grid's face f lies in its face f/4.
/// Nothing where there is no such grid: for `ico:L`, and for `octa:N` with (N − 1)/2 and `cube:N`
/// with N a power of two, there are as many as the edges can be halved; for others none.
std::optional<GridSpec> coarser_grid(const GridSpec& spec, int halvings);

/// A mesh of the unit sphere: closed, genus 0, counter-clockwise from outside; every diagonal of a
/// quad leaves two positive triangles, so that it may be cut either way.
struct SphereGrid {
  Points directions;  // unit
  Polygons faces;     // triangles and quads

  /// Grids by subdivision (`ico:L`; `octa:N` with (N − 1)/2, `cube:N` with N a power of two): how
  /// many vertices each level has, coarse to fine; empty for others. Vertices of a level come
  /// first in the next one, and face f of a level lies in face f/4 of the level above.
  std::vector<int> level_vertices;
  /// With `ancestry`: what each vertex is the middle of, two or four vertices of the level before;
  /// −1 fills up; a vertex of level 0 names itself.
  std::vector<std::array<int, 4>> parents;

  std::string name = {};              // for provenance and messages: "ico:7", "like:sphere.ply"
  std::optional<GridSpec> spec = {};  // of a family; nothing for another sphere's vertices
  std::string warning = {};           // of a file whose points are on no sphere about the origin
};

struct GridOptions {
  bool ancestry = false;
  int threads = 0;
};

/// Throws: std::invalid_argument for a spec that `parse_grid` makes of no text: a size that the
/// family does not have, more than `most_grid_vertices`. Ensures: the same bytes for any number of
/// threads. Cost: linear; subdivided topology is OpenSubdiv's, some 0.5 µs a vertex.
SphereGrid make_grid(const GridSpec& spec, const GridOptions& options = {});

/// The rays of a mapped mesh and its triangles as a grid, so that other meshes get its
/// connectivity.
SphereGrid grid_of(const MappedMesh& mapped);

/// The same of a file: its rays sx sy sz, or its vertices about the origin where it has none, so
/// that bare spheres are grids.
/// Throws: ReadError; MeshRefusal for what is no closed genus-0 mesh; NotCertifiedError where the
/// rays are no sphere about the origin. Cost: the certificate's.
SphereGrid load_grid(const std::string& path, const ReadOptions& read = {}, int threads = 0);

}  // namespace sphparam
