#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "mesh/repair/repair_state.h"

namespace sphparam {

/// A vertex of a hole, and the corner of the input beside it whose attributes new corners take.
struct RimVertex {
  Vertex vertex;
  int corner_like;
};
/// The cycle of a hole: boundary sides run from each vertex to the one before.
using Rim = std::vector<RimVertex>;

/// Which vertices are joined by edges.
class EdgeKeys {
 public:
  void insert(Vertex a, Vertex b) { keys_.insert(key(a, b)); }
  bool contains(Vertex a, Vertex b) const { return keys_.contains(key(a, b)); }
  void reserve(size_t count) { keys_.reserve(count); }

 private:
  static std::uint64_t key(Vertex a, Vertex b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 |
           static_cast<std::uint64_t>(std::max(a, b));
  }
  std::unordered_set<std::uint64_t> keys_;
};

/// Fills a hole. edges: all between vertices of the rim; those that are made are added. apart: the
/// rim does not bound a single face, whose copy back to back would be no surface.
/// Requires: at least three vertices. Cost: O(n log n).
void fill_rim(RepairState& state, EdgeKeys& edges, const Rim& rim, bool apart);

/// Closes a hole by faces that are marked as fillers, or not: rings of created vertices, each with
/// half as many as the one before, and one in the middle. No edge of it is there already, whatever
/// surrounds the hole. Requires: at least three vertices. Cost: O(n); no more than 4 n faces.
void close_by_rings(RepairState& state, const Rim& rim, bool as_fillers);

}  // namespace sphparam
