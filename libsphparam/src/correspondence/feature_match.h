#pragma once

#include <optional>
#include <vector>

#include "correspondence/coarse_to_fine.h"
#include "sphparam/correspondence/match.h"

namespace sphparam {

/// A map by features, and what is said of it.
struct FeatureMatch {
  std::optional<SphereMap> map;   // nothing: landmarks could not be reached
  std::vector<double> residuals;  // of these, where the attempt had to give up
  double agreement = 0;           // correlation of the features by the map, the mean over columns
  double confidence = 1;          // in the turn that all begins with; 1 with landmarks
  VectorX begun_with = {};  // correlation of each column after the turn; with landmarks by the map
  // Of surfaces that lie alike in space, the correlation of their places, the mean over axes: by
  // the map, and after the turn; nothing with landmarks.
  double place_agreement = 0;
  std::optional<double> places_begun_with = {};
  double better_opposed = 0;  // how much greater it would be, at most, with one side's sign changed
};

/// From coarse to fine between the spheres of both surfaces, which have no folds that coarse levels
/// could not have, by how features agree; then between the surfaces themselves. Begins with
/// landmarks, or with the rotation after which features agree best: some are tried; or, if the
/// surfaces lie `alike` in space, with the one after which places do.
/// Same bits for any number of threads. Throws: Cancelled; SolveError.
FeatureMatch match_by_features(const MappedMesh& from, const MappedMesh& to,
                               const TargetSurface& target, const ComposedOptions& options,
                               const MatchFeatures& features, bool alike);

/// A map from a turn, and the confidence in it.
struct TurnedMatch {
  SphereMap map;
  double confidence;
};

/// From the rotation after which the maps look most alike: of those at which curvature and area
/// correlate most, the one of a coarse level that distorts least and lets curvatures agree; or, if
/// the surfaces lie `alike` in space, the one after which places correlate most. From there on
/// distortion alone counts. Same bits for any number of threads. Throws: Cancelled; SolveError.
TurnedMatch match_by_turn(const MappedMesh& from, const MappedMesh& to, const TargetSurface& target,
                          const ComposedOptions& options, bool alike);

}  // namespace sphparam
