#pragma once

#include <cstdint>

#include "chart/flat_mesh.h"
#include "sphparam/progress.h"

namespace sphparam {

/// What unfolding did.
struct Unfolding {
  int folded_faces = 0;  // before
  int splits = 0;
  int nudged_vertices = 0;
  bool at_limit = false;   // more splits were needed than may be made: nothing more was done
  std::vector<Face> left;  // still not positive: as thin as the rounding of (u, v)
};

/// Which fold is split next. As they are found, folds that chase each other from strip to strip end
/// soonest; the deepest first, those that are left where splits end are shallow.
enum class FoldOrder { AsFound, DeepestFirst };

/// Splits edges, at geodesic points, until every face is positive in (u, v); where only rounding
/// folds one, nudges its corners. Faces that are positive on the sphere stay so.
/// Told of "chart": the share of `most_splits` that was needed so far. Throws: Cancelled.
/// Cost: one pass; 1 to 3 µs a split.
Unfolding unfold(FlatMesh& flat, std::int64_t most_splits, FoldOrder order, int threads,
                 const Progress& progress);

}  // namespace sphparam
