#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <vector>

#include "embedding/pack_kernel.h"

namespace sphparam {

/// A dense N×M block, row by row.
template <int N, int M = N>
struct Block {
  std::array<float, static_cast<size_t>(N) * static_cast<size_t>(M)> a{};

  float& operator()(int i, int j) { return a[static_cast<size_t>(i * M + j)]; }
  float operator()(int i, int j) const { return a[static_cast<size_t>(i * M + j)]; }
};

/// One number of every unknown. Steps are solved for to one digit or two: floats hold that in half
/// the memory, and half the time.
using Unknowns = std::vector<float>;

/// A symmetric sparse matrix of N×N blocks; the rows' neighbours without the row itself.
template <int N>
struct BlockMatrix {
  std::vector<int> start, column;  // row r: column[start[r]] … column[start[r + 1] − 1]
  std::vector<Block<N>> off;       // at those columns
  std::vector<Block<N>> diagonal;

  int rows() const { return static_cast<int>(start.size()) - 1; }
};

/// An order of the rows for Gauss–Seidel: blocks of consecutive rows, coloured so that blocks of a
/// colour share no entry. Blocks of a colour may be swept at the same time, with the same result.
struct SweepOrder {
  std::vector<int> first_row;     // #blocks + 1
  std::vector<int> blocks;        // colour by colour
  std::vector<int> colour_start;  // #colours + 1, into `blocks`
};

/// Blocks of `size` consecutive rows.
SweepOrder order_sweeps(const std::vector<int>& start, const std::vector<int>& column, int size);

/// Approximate inverse of the Hessian of an energy of maps to the sphere that does not change when
/// the sphere turns: one symmetric V-cycle of algebraic multigrid.
///
/// Unknowns are clustered by strong connections; a cluster moves like a small rigid plate: by the
/// three infinitesimal rotations of the sphere and, as limbs of conformal maps want it, by a
/// dilation about its own centre. Symmetric block Gauss–Seidel smooths on every level.
/// Our own application of smoothed-free aggregation: Vaněk, Mandel and Brezina, "Algebraic
/// multigrid by smoothed aggregation" (1996), the candidates without their smoothing.
class Multigrid {
 public:
  static constexpr int modes = 4;

  /// The matrix, the points and the units must stay where they are. The unknowns of a row are its
  /// point's tangent coordinates in the row's unit, a length of about that of its edges. Clusters
  /// are made from the matrix's values at this moment. `pinned` rows (identity, no off entries)
  /// are left alone. Cost: linear.
  Multigrid(const BlockMatrix<2>& matrix, const SweepOrder& order, const ImagePoint* points,
            const float* units, const std::vector<char>& pinned, int threads);

  /// Takes the values the matrix has now, and points near those the clusters were made with.
  void update(const ImagePoint* points);

  /// x = M⁻¹ b, M symmetric and positive definite. `residual` is room for one more vector.
  void apply(const Unknowns& b, Unknowns& x, Unknowns& residual);

  int levels() const { return static_cast<int>(levels_.size()); }

 private:
  /// Where a node's modes are measured, and the cluster's radius.
  struct Site {
    Vector3 centre;
    double radius;
  };
  struct Clusters {
    std::vector<int> of_row;          // −1: pinned
    std::vector<int> start, members;  // cluster → rows
  };
  struct Level {
    BlockMatrix<modes> matrix;
    std::vector<Block<modes>> inverse;  // of the diagonal
    SweepOrder order;
    std::vector<Site> sites;
    Clusters clusters;                       // to the next level; empty on the last
    std::vector<Block<modes>> prolongation;  // from the next level
    Unknowns b, x, r, first_x;
  };

  template <int N>
  bool coarsen(const BlockMatrix<N>& matrix, const std::vector<char>& pinned, Clusters& clusters);
  void fill_first();
  std::vector<Block<2, modes>> first_prolongation() const;
  void restrict_first(const float* r, float* b) const;
  void prolong_first(const float* y, float* x) const;
  void fill(size_t level);
  Eigen::SparseMatrix<double> coarsest_matrix() const;
  void cycle(size_t level);

  const BlockMatrix<2>& matrix_;
  const SweepOrder& order_;
  const ImagePoint* points_;
  const float* units_;
  int threads_;
  Clusters clusters_;
  std::vector<Level> levels_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> coarsest_;
};

struct LinearSolution {
  Unknowns x;
  double gain = 0;  // b·x = xᵀ A x, twice what the step lowers the quadratic model by
  int iterations = 0;
};

/// Preconditioned conjugate gradients for A x = b, until the residual in the preconditioner's norm
/// has fallen to `tolerance` of what it was. Uses b up. Same bits for any number of threads.
LinearSolution solve_by_conjugate_gradients(const BlockMatrix<2>& matrix, Multigrid& multigrid,
                                            Unknowns b, double tolerance, int most_iterations,
                                            int threads);

}  // namespace sphparam
