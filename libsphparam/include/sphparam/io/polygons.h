#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// The faces of a file, as they were written: polygon p has the corners
/// corners[starts[p]] … corners[starts[p + 1] − 1], each the index of a vertex.
struct Polygons {
  std::vector<int> corners;    // indices of vertices, polygon after polygon
  std::vector<int> starts{0};  // where each begins in `corners`, and at last where all end
  std::vector<int> repeating;  // polygons that name a vertex twice, where options let them pass

  std::int64_t count() const { return static_cast<std::int64_t>(starts.size()) - 1; }
  /// How many corners a polygon has, and which they are.
  int degree(std::int64_t p) const { return starts[p + 1] - starts[p]; }
  std::span<const int> polygon(std::int64_t p) const {
    return {corners.data() + starts[p], static_cast<std::size_t>(degree(p))};
  }

  bool repeats(std::int64_t p) const {
    return std::binary_search(repeating.begin(), repeating.end(), p);
  }

  void add_corner(int vertex) { corners.push_back(vertex); }

  /// Ends the polygon of the corners added since the last call. Returns what is wrong with it
  /// (too few or too many corners, a vertex twice unless options let it pass, too many faces);
  /// empty when all is well.
  std::string close_polygon(const ReadOptions& options);

  /// Corners added since the last closed polygon.
  std::int64_t open_degree() const {
    return static_cast<std::int64_t>(corners.size()) - starts.back();
  }

 private:
  std::int64_t triangle_count_ = 0;
};

/// The triangles of some polygons, in the order of the polygons.
struct Triangulation {
  Triangles triangles;
  std::vector<int> corner;    // #T·3: which of the polygons' corners; empty when corner i is i
  std::vector<int> polygon;   // #T: which polygon; empty when triangle t is polygon t
  long split = 0;             // polygons that were not triangles
  long shortened = 0;         // polygons that named a vertex twice in a row, taken once
  long overlapping = 0;       // polygons of more than four corners with triangles that overlap
  std::vector<int> doublets;  // vertices about which two polygons share two edges in a row

  std::int64_t corner_of(std::int64_t i) const { return corner.empty() ? i : corner[i]; }
  std::int64_t polygon_of(std::int64_t t) const { return polygon.empty() ? t : polygon[t]; }
};

/// Cuts polygons into triangles of the same orientation.
///
/// Quads are cut along the shorter diagonal that leaves both triangles unfolded. Other polygons
/// become the fan of their first corner where that fan does not fold in the polygon's best-fit
/// plane, else their ears are clipped there; beyond 4096 corners always the fan, as ears cost the
/// square of the degree. Triangles overlap where that fan folds, and where a polygon crosses
/// itself, and such polygons are counted. No cut runs along an edge that the polygons or another
/// cut have already, where there is a choice. Where two polygons share two edges in a row (about a
/// vertex of valence two, a doublet) the triangle between these edges is cut off from both: the
/// surface has it twice, and `inspect_mesh` says so; `repair_mesh` turns the other diagonal of one
/// of them. Of a polygon that names a vertex twice in a row, as quads do that are triangles, the
/// second corner is left out. What repeats a vertex even so, or would have fewer than three
/// corners, becomes one triangle that repeats one, for `repair_mesh` to remove.
/// Requires: indices within `positions`. Cost: O(corners), plus degree² for clipped polygons.
Triangulation triangulate(const Points& positions, const Polygons& polygons);

/// Triangles as polygons, in their order.
Polygons triangles_as_polygons(const Triangles& triangles);

/// Of each corner of the polygons one of the triangles (3·triangle + corner) at the same vertex.
/// Requires: the triangles are the polygons cut, in their order; none names a vertex twice.
/// Throws: std::logic_error where they are not. Cost: O(corners).
std::vector<int> corners_in(const Triangles& triangles, const Polygons& polygons);

/// Puts the triangles into a mesh file: triangles, polygon count and, where a polygon was split,
/// the face property `source_face`. Face properties, so far one value a polygon, are copied to
/// every triangle of the polygon. Notes tell of shortened polygons, of those whose triangles
/// overlap, and of doublets.
void adopt_triangulation(MeshFile& file, Triangulation triangulation);

}  // namespace sphparam
