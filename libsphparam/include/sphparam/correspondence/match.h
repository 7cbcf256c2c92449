#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/correspondence/surface_map.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

/// A vertex of one surface and the vertex of the other that it goes to.
struct LandmarkPair {
  Vertex from, to;
};

/// Values at the vertices of two surfaces that are to agree where they come to lie: sulcal depth,
/// curvature. A column a feature, in whatever unit; what is not finite counts as the median.
struct MatchFeatures {
  Functions from, to;  // #V×k each
  double weight = 2;   // > 0: of their mean square difference, in spreads, against the energy
};

struct MatchOptions {
  std::vector<LandmarkPair> landmarks = {};  // held exactly; no vertex twice on either side
  /// For landmarks, to start from, and where there are none that a map has for a turn; none are
  /// held. Requires: none are given.
  bool search = false;
  /// `from` and `to` lie alike in space, as files of one rig or scanner do: a search is also judged
  /// by how well places agree, in their coordinates, and where they are nearest to one another is a
  /// start too; with features, the first turn is by how places agree alone.
  bool alike = false;
  /// What is to agree besides. Without landmarks the first map is turned so that it does, to begin
  /// with. Requires: no search.
  std::optional<MatchFeatures> features = {};
  /// Of the composition, flat triangle to flat triangle. Symmetric Dirichlet, or the default energy
  /// of maps with its λ; ε and pressure are not used.
  DistortionEnergy energy = {.kind = EnergyKind::SymmetricDirichlet};
  int threads = 0;  // 0: all cores. The result does not depend on it.
  Progress progress = {};
};

/// Vertices at the ends of what sticks out of two surfaces, which might correspond.
struct SuggestedLandmarks {
  std::vector<LandmarkPair> landmarks = {};
  double energy = 0;     // of the map between coarse levels that they lead to, of a unit of area
  double agreement = 0;  // correlation of the surfaces' bounded mean curvatures by it
  double place_agreement = 0;  // the same of places in space, of surfaces that lie alike there
  double score = 0;  // the less, the better: energy · (1 − agreement) · (1 − place agreement)
};

struct Match {
  SurfaceMap map;  // `from` with its map moved, `to` as it was
  double energy;   // of the composition as it was minimised, bounded where triangles collapse (see
                   // docs/mathematics.md), a unit of area; of symmetric Dirichlet isometry has 2
  std::string made_by;  // "coarse to fine", "own map", "turn", "places" (nearest in space),
                        // "features": what it came from
  std::vector<double> residuals;  // radians of the landmarks from their partners; 0: exactly there
  /// What was found, the best first; none where another start leads elsewhere, with less energy.
  std::vector<SuggestedLandmarks> suggestions;
  /// In the first of these, or in the turn that surfaces without ends or features begin with: 0
  /// where another is as good, 1 where there is none. In a turn that surfaces without ends begin
  /// with, at most 0.05 over how much more energy it has than an isometry, as a share of that's.
  /// In another start that leads elsewhere than what was found: by how much more energy that has.
  double confidence = 1;
  double agreement = 0;        // of features: their correlation by the map, the mean over columns
  double place_agreement = 0;  // beside features, of surfaces that lie alike: that of places, over
                               // axes
  /// For people: a surface that is inside out where the other is not, landmarks that a mirror image
  /// fits as well, area that shrinks to nothing on the other surface, little confidence, a turn for
  /// want of ends that is far from an isometry, features of which one side lacks a part or has
  /// other signs, or that pull apart what lies alike.
  std::vector<std::string> warnings;
};

/// Landmarks that were given and that no match has. The program ends with exit code 5.
class UnreachableLandmarks : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Landmarks that fit the mirror image of the first surface far better than the surface.
class MirroredLandmarks : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Maps one surface to another with the least distortion of the map between them: the points of the
/// first on the sphere move, those of the second stay.
///
/// Ensures: both maps are proved one-to-one; each landmark of `from` has exactly the direction of
/// its partner. Same bits for any number of threads.
/// Throws: std::invalid_argument for options outside their domains, for landmarks that are no
/// vertices, or one twice, and for a feature that is the same everywhere;
/// UnreachableLandmarks; MirroredLandmarks; UnmeasurableMesh, with the name, for a surface without
/// area; Cancelled.
/// Cost: 0.1 ms a triangle. Source: our own; the energy is that of Schmidt et al., "Surface maps
/// via adaptive triangulations" (2023), where it is that of a common refinement.
Match match_surfaces(const MappedMesh& from, const MappedMesh& to,
                     const MatchOptions& options = {});

}  // namespace sphparam
