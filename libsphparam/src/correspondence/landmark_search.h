#pragma once

#include <vector>

#include "correspondence/coarse_to_fine.h"
#include "sphparam/correspondence/match.h"

namespace sphparam {

/// Landmarks that the shapes themselves suggest, the best first: their ends paired so that the map
/// between coarse levels distorts little and mean curvatures agree, and places in space, too, if
/// the surfaces lie `alike` there. Empty: one of them has fewer than three ends, or no pairing has
/// a map. Same for any number of threads. Cost: some seconds.
std::vector<SuggestedLandmarks> suggest_landmarks(const MappedMesh& from, const MappedMesh& to,
                                                  const TargetSurface& target,
                                                  const ComposedOptions& options, bool alike);

/// From 0, where the second best that says something else is as good, to 1, where there is none.
/// Requires: at least one.
double confidence_of(const std::vector<SuggestedLandmarks>& suggestions);

}  // namespace sphparam
