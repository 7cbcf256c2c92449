#pragma once

#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Closed components within the largest one, by area, whose faces look the other way: the borders
/// of cavities in what that encloses.
struct Cavities {
  std::vector<Vertex> lowest;  // of the vertices of each, in ascending order
  /// Of those that lie there, in no cavity, and look the same way: the largest encloses them, too.
  std::vector<Vertex> lowest_of_solids;
  double volume = 0;  // of all cavities
  double share = 0;   // of what the largest component encloses, the cavities included
};

/// None where there is one component, or the largest is not closed. Where a component lies, its
/// lowest vertex says, exactly. None either of a mesh with vertices without a place, or faces that
/// name none. Cost: O(#V + #F log #F).
Cavities find_cavities(const TriangleMesh& mesh);

}  // namespace sphparam
