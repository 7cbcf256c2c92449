#pragma once

#include "chart/flat_mesh.h"

namespace sphparam {

/// What unfolding did.
struct Unfolding {
  int folded_faces = 0;  // before
  int splits = 0;
  int nudged_vertices = 0;
  std::vector<Face> left;  // still not positive: as thin as the rounding of (u, v)
};

/// Splits edges, at geodesic points, until every face is positive in (u, v); where only rounding
/// folds one, nudges its corners. Faces that are positive on the sphere stay so.
/// Cost: one pass; 1 to 3 µs a split, 256 splits a fold and 4096 at most.
Unfolding unfold(FlatMesh& flat, int threads);

}  // namespace sphparam
