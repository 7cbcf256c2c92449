#pragma once

#include <optional>
#include <vector>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

/// A vertex and the point of the sphere it is to lie at.
struct Pin {
  Vertex vertex;
  Vector3 point;  // of unit length up to rounding; the result has exactly these doubles
};

struct LandmarkOptions {
  DistortionEnergy energy = {};
  // None below 0:
  int sweeps = 10;        // of pinned relaxation after every move
  int most_rounds = 400;  // of moves; it gives up earlier where they stall
  int most_detours = 4;   // tried by pins that stand in each other's way
  int threads = 0;        // 0: all cores
  Progress progress = {};
};

struct LandmarkPlacement {
  SphereMap map;
  std::vector<double> residuals;  // per pin: distance to its point in radians; 0 is exact
  int rounds = 0;
  int detours = 0;

  bool exact() const;  // every residual is 0
};

/// Moves vertices of a bijective map to given points and keeps it bijective.
///
/// The rotation that fits the pins best comes first, unless a pin is at its point already. Then, in
/// rounds: a smooth field takes every pin, and what lies around it, along its great circle as far
/// as nothing folds; guarded relaxation, all pins held, makes room for the next round. Pins that
/// block each other are let go for a moment, and all give way to the right, as people do in a
/// corridor. Where the mesh does not allow the points (adjacent vertices at opposite points, a
/// wrong cyclic order round a short ring) the pins stop on their way: the residuals tell how far
/// from their points, the map is valid all the same. Requires: a bijective map.
/// Ensures: no triangle folds; same bits for any number of threads.
/// Throws: std::invalid_argument for pins that are no vertices, twice the same, or at points whose
///         squared length is not 1 to 1e-6, and for options outside of their domain; Cancelled.
/// Cost: a round takes `sweeps` of relaxation and O(#V·#pins + #pins³): meant for coarse meshes,
/// see
///       ProgressiveOptions::pins, and for few rounds on others.
/// Our own; the field is the radial interpolation of Joshi and Miller, "Landmark matching via large
/// deformation diffeomorphisms" (2000).
LandmarkPlacement place_landmarks(const Topology& topology, const RestTriangles& source,
                                  const SphereMap& map, const std::vector<Pin>& pins,
                                  const LandmarkOptions& options = {});

/// A triangle with three pinned corners whose points are not counter-clockwise: no map has
/// these pins. Decided exactly. Requires: no vertex twice; finite points.
/// Cost: the valences of the pins.
std::optional<Face> face_folded_by(const Topology& topology, const std::vector<Pin>& pins);

/// The rotation R with least Σ |R x(vertex) − point|².
/// Paper: Kabsch, "A solution for the best rotation to relate two sets of vectors" (1976).
Eigen::Matrix3d best_rotation(const SphereMap& map, const std::vector<Pin>& pins);
/// The rotation R with least Σ |R from − to|² over the rows.
Eigen::Matrix3d best_rotation(const Points& from, const Points& to);

/// Per pin: the angle between its vertex's image and its point; 0 only where all bits agree.
std::vector<double> pin_residuals(const SphereMap& map, const std::vector<Pin>& pins);

/// All residuals are 0; false when there are none.
bool all_exact(const std::vector<double>& residuals);

}  // namespace sphparam
