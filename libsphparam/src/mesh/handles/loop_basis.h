#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Loops of a closed surface that do not separate it, and what tells such loops from others.
struct LoopBasis {
  /// Per half-edge, the same for its twin. Exclusive or along a closed walk: 0 where the walk
  /// bounds a piece of surface (up to one chance in 2⁶⁴); the same for all walks that bound one
  /// together.
  std::vector<std::uint64_t> labels;
  /// Simple, two a handle. Each loop that does not separate its component crosses one of them.
  std::vector<std::vector<Vertex>> loops;
};

/// By a tree of edges and one of dual edges that do not cross it; the edges left over close the
/// loops (Eppstein, "Dynamic generators of topologically embedded graphs", 2003). Components are
/// any number, vertices without faces are allowed. Cost: O(#V + #F), near enough; without handles
/// that of the first tree.
LoopBasis loop_basis(const Topology& topology);

}  // namespace sphparam
