#pragma once

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
  int sweeps = 3;         // of pinned relaxation after every round of moves
  int most_rounds = 400;  // of moves; it gives up earlier where they stall
  int threads = 0;        // 0: all cores
  Progress progress = {};
};

struct LandmarkPlacement {
  SphereMap map;
  std::vector<double> residuals;  // per pin: distance to its point in radians; 0 is exact
  int rounds = 0;

  bool exact() const;  // every residual is 0
};

/// Moves vertices of a bijective map to given points and keeps it bijective.
///
/// The rotation that fits the pins best comes first. Then, in rounds, every pin goes along its
/// great circle as far as the kernel of its ring lets it, and guarded relaxation, all pins held,
/// makes room for the next round. Where the mesh does not allow the points (adjacent vertices at
/// opposite points, a wrong cyclic order round a short ring) the pins stop on their way: the
/// residuals tell how far from their points, the map is valid all the same.
/// Requires: a bijective map; no vertex twice. Ensures: every triangle with det > 0 keeps it, but
///           for rounding in the first rotation, which is left out where it would fold something;
///           same bits for any number of threads. Cost: some rounds × sweeps of relaxation; meant
///           for coarse meshes, see ProgressiveOptions::pins.
/// Our own.
LandmarkPlacement place_landmarks(const Topology& topology, const SourceTriangles& source,
                                  const SphereMap& map, const std::vector<Pin>& pins,
                                  const LandmarkOptions& options = {});

/// The rotation R with least Σ |R x(vertex) − point|².
/// Paper: Kabsch, "A solution for the best rotation to relate two sets of vectors" (1976).
Eigen::Matrix3d best_rotation(const SphereMap& map, const std::vector<Pin>& pins);

/// Per pin: the angle between its vertex's image and its point; 0 only where all bits agree.
std::vector<double> pin_residuals(const SphereMap& map, const std::vector<Pin>& pins);

}  // namespace sphparam
