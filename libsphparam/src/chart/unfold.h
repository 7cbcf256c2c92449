#pragma once

#include "chart/flat_mesh.h"

namespace sphparam {

/// What unfolding did.
struct Unfolding {
  int folded_faces = 0;  // before
  int splits = 0;
  int nudged_vertices = 0;
  std::vector<Face> left;  // still not positive: smaller than the rounding of (u, v)
};

/// Splits edges, at geodesic points, until every face is positive in (u, v); where only rounding
/// folds one, nudges its corners.
/// Cost: one pass; a few µs a split.
Unfolding unfold(FlatMesh& flat, int threads);

}  // namespace sphparam
