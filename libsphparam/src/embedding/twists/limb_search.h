#pragma once

#include <vector>

#include "embedding/twists/loop_search.h"

namespace sphparam {

/// Loops of a few vertices round a limb, each beside the one before, from one end to the other. No
/// vertex is in two of them.
using Limb = std::vector<VertexLoop>;

/// Finds the limbs of a surface one by one. Our own.
class LimbSearch {
 public:
  /// Requires: the topology outlives it.
  explicit LimbSearch(const Topology& topology);

  /// Another limb; empty: there is none left. Hubs (`LoopSearch::is_hub`) are in no limb.
  /// Cost: of all limbs together O(#V log #V), about 1 µs a vertex.
  Limb next();

 private:
  Limb limb_with(const VertexLoop& loop);
  std::vector<VertexLoop> layers_beyond(const VertexLoop& loop, Flank flank);
  bool is_loop(VertexLoop& layer) const;
  void mark(const VertexLoop& layer);

  const Topology& topology_;
  LoopSearch loops_;
  Vertex next_ = 0;         // where the next loop is looked for
  std::vector<char> used_;  // by a limb
};

}  // namespace sphparam
