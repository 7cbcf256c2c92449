#pragma once

#include <vector>

#include "mesh/repair/repair_state.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Cuts along simple loops and closes both rims of each: faces to the left of a loop get copies of
/// its vertices. Logs a handle that is cut, or filled.
/// Requires: `topology` is that of the state, loops have no vertex in common.
struct LoopToCut {
  std::vector<Vertex> vertices;
  bool filled;
  double diagonal;  // of the part that it is in
};
void cut_along(RepairState& state, const Topology& topology, const std::vector<LoopToCut>& loops);

}  // namespace sphparam
