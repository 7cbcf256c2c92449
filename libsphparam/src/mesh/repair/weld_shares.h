#pragma once

#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Distances, in diagonals of the bounding box, within which nearly every vertex on a boundary has
/// another one, though edges of the boundary are much longer: at which welding
/// (`RepairOptions::weld_share`) may join what only small errors keep apart. 1, 2 or 5 times powers
/// of ten, the smallest first; none: there is no such distance, or some vertex has no place. Ours:
/// the data says which distances are errors and which are shape, where there is a gap between the
/// two. Where few vertices are torn apart there is none, as most of a tear's have no other near:
/// then the rounding of float32 alone, if any vertex is as near as that to another one, or to an
/// edge. Cost: O(#F log #F).
std::vector<double> weld_shares(const TriangleMesh& mesh);

/// The rounding of float32 as such a distance, if any vertex on a boundary is as near as that to
/// another one, and most edges there are much longer; else 0. Cost: O(#F log #F), little of it.
double rounding_weld(const TriangleMesh& mesh);

}  // namespace sphparam
