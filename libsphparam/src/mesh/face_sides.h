#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A side of a face, with its vertices in increasing order. Sorted sides are the connectivity of
/// meshes that have no half-edge structure.
struct FaceSide {
  Vertex low, high;
  Halfedge halfedge;  // 3·face + corner
  bool forward;       // the face runs from low to high
};

/// The sides of the faces with wanted(f), sorted by edge, then by half-edge. Linear time where no
/// vertex has many faces: sides go to their lower vertex first, then each few are sorted.
/// Requires: no index below 0 in these faces.
template <class Wanted>
std::vector<FaceSide> sorted_sides(const Triangles& triangles, Wanted&& wanted) {
  const auto for_each_side = [&](auto&& visit) {
    for (Face f = 0; f < static_cast<Face>(triangles.rows()); ++f) {
      if (!wanted(f)) continue;
      for (int k = 0; k < 3; ++k) {
        const Vertex a = triangles(f, k), b = triangles(f, (k + 1) % 3);
        visit(FaceSide{std::min(a, b), std::max(a, b), 3 * f + k, a < b});
      }
    }
  };
  Vertex highest = -1;
  for_each_side([&](const FaceSide& side) { highest = std::max(highest, side.low); });
  std::vector<size_t> ends(static_cast<size_t>(highest) + 2, 0);  // of each lower vertex's sides
  for_each_side([&](const FaceSide& side) { ++ends[static_cast<size_t>(side.low) + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<FaceSide> sides(ends.back());
  for_each_side([&](const FaceSide& side) { sides[ends[static_cast<size_t>(side.low)]++] = side; });
  auto first = sides.begin();
  for (Vertex low = 0; low <= highest; ++low) {
    const auto last = sides.begin() + static_cast<std::ptrdiff_t>(ends[static_cast<size_t>(low)]);
    std::sort(first, last, [](const FaceSide& x, const FaceSide& y) {
      return std::tie(x.high, x.halfedge) < std::tie(y.high, y.halfedge);
    });
    first = last;
  }
  return sides;
}

/// Calls visit(first, last) for every edge: its sides are sides[first] … sides[last − 1].
template <class Visit>
void for_each_edge(const std::vector<FaceSide>& sides, Visit&& visit) {
  for (size_t i = 0; i < sides.size();) {
    size_t j = i + 1;
    while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) ++j;
    visit(i, j);
    i = j;
  }
}

/// The corner of the side's face at one of the side's two vertices.
inline int corner_at(const FaceSide& side, Vertex v) {
  const Halfedge h = side.halfedge;
  const bool starts_there = side.forward ? v == side.low : v == side.high;
  return starts_there ? h : (h % 3 == 2 ? h - 2 : h + 1);
}

}  // namespace sphparam
