#pragma once

#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// x becomes scale · rotation · (x − centre) + place.
struct ProcrustesMotion {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  double scale = 1;
  Vector3 centre = Vector3::Zero(), place = Vector3::Zero();
};

/// Requires: nothing. Cost: one pass.
Points moved(const Points& points, const ProcrustesMotion& motion);

struct ProcrustesOptions {
  bool scale = false;  // each to the mean of the sizes
  /// Of the shapes, each ≥ 0; of size 0 a shape is not scaled. Empty: RMS distances from their
  /// centres, so weighted.
  VectorX sizes = {};
  int most_iterations = 200;  // ≥ 1
  double tolerance = 1e-13;   // ≥ 0: RMS change of the mean in an iteration, of its size
  int threads = 0;
};

/// Shapes of corresponding points, moved, turned and, where wanted, scaled onto their mean.
struct Procrustes {
  std::vector<Points> shapes;             // moved
  std::vector<ProcrustesMotion> motions;  // of each
  Points mean;                            // of the moved shapes
  int iterations = 0;
};

/// Moves and turns shapes so that the sum of the weighted squares of their points' distances from
/// their mean is least. The mean lies as `reference`, a shape of the same points, does: with its
/// centre, and turned to it. Rotations are proper: a mirror image stays one.
/// Requires: at least one shape; as many points in all, and weights, which are at least 0 and sum
/// to 1 up to 1e-9. Throws: std::invalid_argument if not, and for options outside their domains.
/// Ensures: the same bits for any number of threads.
/// Source: Gower, "Generalized Procrustes analysis" (1975).
Procrustes align_by_procrustes(const std::vector<Points>& shapes, const Points& reference,
                               const VectorX& weights, const ProcrustesOptions& options = {});

/// RMS distances, so weighted, of each two shapes, one moved and turned onto the other; not scaled.
/// Symmetric, 0 on the diagonal. Same requirements. Cost: a pass a pair.
MatrixX procrustes_distances(const std::vector<Points>& shapes, const VectorX& weights,
                             int threads = 0);

}  // namespace sphparam
