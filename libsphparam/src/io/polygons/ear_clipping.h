#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "io/polygons/distinct_rows.h"

namespace sphparam {

/// The undirected edges in use.
class EdgeSet {
 public:
  explicit EdgeSet(std::size_t expected) : rows_(expected) {}
  void insert(int a, int b) { rows_.insert(ordered(a, b)); }
  bool contains(int a, int b) const { return rows_.contains(ordered(a, b)); }

 private:
  static std::array<int, 2> ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  DistinctRows<int, 2> rows_;
};

using PlanePoint = Eigen::Vector2d;

/// Appends the triangles of a polygon, as triples of its corners, that keep its orientation where
/// it does not cross itself: `plane` has the corners' places. An ear along an edge in use is cut
/// only where there is no other.
/// Requires: at least 3 corners. Ensures: degree − 2 triangles. Cost: O(degree²) at most.
void clip_ears(std::span<const int> polygon, std::vector<PlanePoint> plane, const EdgeSet& edges,
               std::vector<int>& triples);

/// Do triangles of a polygon overlap: are their areas more than its own?
bool overlap(const std::vector<PlanePoint>& plane, std::span<const int> triples);

}  // namespace sphparam
