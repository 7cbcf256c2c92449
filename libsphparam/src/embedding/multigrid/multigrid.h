#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "embedding/multigrid/aggregates.h"
#include "embedding/multigrid/block_gauss_seidel.h"
#include "embedding/multigrid/block_matrix.h"
#include "embedding/multigrid/near_nullspace.h"

namespace sphparam {

/// Approximate inverse of the Hessian of an energy of maps to the sphere that does not change when
/// the sphere turns: one symmetric V-cycle of algebraic multigrid.
///
/// Unknowns are aggregated by strong connections; an aggregate moves like a small rigid plate: by
/// the three infinitesimal rotations of the sphere and, as protrusions of conformal maps want it,
/// by a dilation about its own centre. Symmetric block Gauss–Seidel smooths on every level. Our own
/// application of smoothed-free aggregation: Vaněk, Mandel and Brezina, "Algebraic multigrid by
/// smoothed aggregation" (1996), the candidates without their smoothing.
class Multigrid {
 public:
  /// The matrix, the points and the units must stay where they are. The unknowns of a row are its
  /// point's tangent coordinates in the row's unit, a length of about that of its edges. Aggregates
  /// are made from the matrix's values at this moment. `pinned` rows (identity, no off entries)
  /// are left alone. Cost: linear.
  Multigrid(const BlockMatrix<2>& matrix, const SweepOrder& order, const ImagePoint* points,
            const float* units, const std::vector<char>& pinned, int threads);

  /// Takes the values the matrix has now, and points near those the aggregates were made with.
  void update(const ImagePoint* points);

  /// x = M⁻¹ b, M symmetric, and positive definite where the matrix is semidefinite. `residual` is
  /// room for one more vector.
  void apply(const Unknowns& b, Unknowns& x, Unknowns& residual);

  int levels() const { return static_cast<int>(levels_.size()); }

 private:
  static constexpr int modes = near_nullspace;
  struct Level {
    BlockMatrix<modes> matrix;
    std::vector<Block<modes>> inverse;  // of the diagonal
    SweepOrder order;
    std::vector<AggregateSite> sites;
    Aggregates aggregates;                   // to the next level; empty on the last
    std::vector<Block<modes>> prolongation;  // from the next level
    Unknowns b, x, r, first_x;
  };

  template <int N>
  bool coarsen(const BlockMatrix<N>& matrix, const std::vector<char>& pinned,
               Aggregates& aggregates);
  void fill_first();
  void fill(size_t level);
  void cycle(size_t level);

  const BlockMatrix<2>& matrix_;
  const SweepOrder& order_;
  PointRows rows_;
  int threads_;
  Aggregates aggregates_;
  std::vector<Level> levels_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> coarsest_;
};

}  // namespace sphparam
