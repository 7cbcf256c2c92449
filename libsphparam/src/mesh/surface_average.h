#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Averages over a distance on a closed surface, with standard deviation `scale` in each direction:
/// of a measure m, whose density is m/A, the density h with (A + ½s² L) h = m, one implicit step of
/// heat flow with positive weights.
///
/// Ensures: h stays between the extremes of m/A; Σ A h = Σ m up to rounding; same bits for any
/// number of threads.
class SurfaceAverage {
 public:
  /// face_area: #F, 0 or more; area: #V, of the vertices, above 0.
  /// Requires: squares of the positions neither overflow nor vanish; scale > 0.
  /// Cost: a sparse matrix, 100 bytes a vertex.
  SurfaceAverage(const TriangleMesh& mesh, const Topology& topology, const VectorX& face_area,
                 VectorX area, double scale);
  SurfaceAverage(const SurfaceAverage&) = delete;
  SurfaceAverage& operator=(const SurfaceAverage&) = delete;

  /// Throws: SolveError. Cost: about 0.1 µs a vertex and edge length that the scale spans.
  VectorX operator()(const VectorX& measure) const;

 private:
  using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  VectorX area_;
  double unit_;  // a power of two: areas divided by it are about 1
  SparseMatrix matrix_;
  Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper> solver_;
};

}  // namespace sphparam
