#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "embedding/multigrid/block_matrix.h"
#include "sphparam/parallel.h"

namespace sphparam {

/// An order of the rows for Gauss–Seidel: blocks of consecutive rows, coloured so that blocks of a
/// colour share no entry. Blocks of a colour may be swept at the same time, with the same result.
struct SweepOrder {
  std::vector<int> first_row;     // #blocks + 1
  std::vector<int> blocks;        // colour by colour
  std::vector<int> colour_start;  // #colours + 1, into `blocks`
};

/// Blocks of `size` consecutive rows.
SweepOrder order_sweeps(const std::vector<int>& start, const std::vector<int>& column, int size);

inline constexpr double diagonal_shift = 1e-10;  // of a block's trace, so that it has an inverse

/// The inverse of a block to which `diagonal_shift` of its trace has been added; of a zero block
/// the identity. Requires: symmetric, finite. Ensures: of a positive semidefinite one symmetric
/// positive definite up to rounding. Cost: O(N³).
template <int N>
Block<N> inverse(const Block<N>& a) {
  using Matrix = Eigen::Matrix<double, N, N, Eigen::RowMajor>;
  Matrix m = Eigen::Map<const Matrix>(a.a.data());
  const double trace = m.trace();
  // A mode that the aggregate does not have (a single row does not turn) has a zero row.
  for (int i = 0; i < N; ++i) m(i, i) += diagonal_shift * trace + (trace > 0 ? 0 : 1);
  Block<N> r;
  Eigen::Map<Matrix>(r.a.data()) = m.inverse();
  return r;
}

/// The same for every block of a diagonal; `result` may be `diagonal` itself. Same bits for any
/// number of threads. Cost: linear.
template <int N>
void invert(const std::vector<Block<N>>& diagonal, std::vector<Block<N>>& result, int threads) {
  result.resize(diagonal.size());
  parallel_for(static_cast<std::int64_t>(diagonal.size()), row_grain, threads,
               [&](std::int64_t begin, std::int64_t end) {
                 for (std::int64_t i = begin; i < end; ++i) {
                   result[static_cast<size_t>(i)] = inverse(diagonal[static_cast<size_t>(i)]);
                 }
               });
}

/// What the row's own unknowns would have to make of the others' work.
template <int N>
[[gnu::always_inline]] inline std::array<double, N> off_residual(const BlockMatrix<N>& a,
                                                                 const double* b, const double* x,
                                                                 int row) {
  std::array<double, N> s = off_product(a, x, row);
  for (int i = 0; i < N; ++i) s[at(i)] = b[N * row + i] - s[at(i)];
  return s;
}

/// The diagonal's inverse is stored for large blocks, …
template <int N>
[[gnu::always_inline]] inline void relax_row(const BlockMatrix<N>& a,
                                             const std::vector<Block<N>>& inverse, const double* b,
                                             double* x, int row) {
  const std::array<double, N> s = off_residual(a, b, x, row);
  const Block<N>& d = inverse[at(row)];
  for (int i = 0; i < N; ++i) {
    double sum = 0;
    for (int j = 0; j < N; ++j) sum += d(i, j) * s[at(j)];
    x[N * row + i] = sum;
  }
}

/// … and computed where it is needed for small ones.
struct SmallInverses {};
[[gnu::always_inline]] inline void relax_row(const BlockMatrix<2>& a, SmallInverses,
                                             const double* b, double* x, int row) {
  const std::array<double, 2> s = off_residual(a, b, x, row);
  const Block<2>& d = a.diagonal[at(row)];
  const double shift = diagonal_shift * (d(0, 0) + d(1, 1));
  const double d0 = d(0, 0) + shift, d1 = d(1, 1) + shift, off = d(0, 1);
  const double scale = 1 / (d0 * d1 - off * off);
  // Before the rows before this one are needed: that is what a sweep waits for.
  const double i0 = scale * d1, i1 = scale * d0, i01 = scale * off;
  x[2 * row] = i0 * s[0] - i01 * s[1];
  x[2 * row + 1] = i1 * s[1] - i01 * s[0];
}

enum class Sweep { Forward, Backward };

/// Solves every row for its own unknowns, in the order or backwards. `inverse`: of the diagonal, or
/// SmallInverses. Same bits for any number of threads.
template <int N, class Inverses>
void sweep(const BlockMatrix<N>& a, const Inverses& inverse, const SweepOrder& order,
           const double* b, double* x, Sweep direction, int threads) {
  const bool forward = direction == Sweep::Forward;
  const int colours = static_cast<int>(order.colour_start.size()) - 1;
  for (int n = 0; n < colours; ++n) {
    const int c = forward ? n : colours - 1 - n;
    const int first = order.colour_start[at(c)], count = order.colour_start[at(c) + 1] - first;
    parallel_for(count, 1, threads, [&](std::int64_t begin, std::int64_t end) {
      for (int k = static_cast<int>(begin); k < static_cast<int>(end); ++k) {
        const int block = order.blocks[at(first + k)];
        const int low = order.first_row[at(block)], high = order.first_row[at(block) + 1];
        if (forward) {
          for (int row = low; row < high; ++row) relax_row(a, inverse, b, x, row);
        } else {
          for (int row = high; row-- > low;) relax_row(a, inverse, b, x, row);
        }
      }
    });
  }
}

}  // namespace sphparam
