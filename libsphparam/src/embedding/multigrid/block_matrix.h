#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lanes.h"
#include "sphparam/parallel.h"

namespace sphparam {

/// Rows are ints, places in vectors are not.
inline size_t at(int i) { return static_cast<size_t>(i); }

inline constexpr std::int64_t row_grain = 512;  // rows that a thread takes at once

/// A dense N×M block, row by row.
template <int N, int M = N>
struct Block {
  std::array<double, static_cast<size_t>(N) * static_cast<size_t>(M)> a{};

  double& operator()(int i, int j) { return a[static_cast<size_t>(i * M + j)]; }
  double operator()(int i, int j) const { return a[static_cast<size_t>(i * M + j)]; }
};

/// One number of every unknown. Doubles, though steps are solved for to a digit or two: what a limb
/// resists a motion with is next to nothing of what each of its triangles would, were it alone.
using Unknowns = std::vector<double>;

/// A symmetric sparse matrix of N×N blocks; the rows' neighbours without the row itself.
template <int N>
struct BlockMatrix {
  std::vector<int> start, column;  // row r: column[start[r]] … column[start[r + 1] − 1]
  std::vector<Block<N>> off;       // at those columns
  std::vector<Block<N>> diagonal;

  int rows() const { return static_cast<int>(start.size()) - 1; }
};

/// aᵀ, as a left factor: nothing is moved.
template <int N, int M>
struct Transposed {
  const Block<N, M>& of;
  double operator()(int i, int j) const { return of(j, i); }
};

template <int N, int M>
Transposed<N, M> transposed(const Block<N, M>& a) {
  return {a};
}

/// r += a b, a block or a transposed one times a block, W columns at a time; each entry's terms in
/// order, whatever W.
template <int W, class Left, int N, int K, int M>
SPHPARAM_INLINE void add_product(const Left& a, const Block<K, M>& b, Block<N, M>& r) {
  static_assert(M % W == 0);
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < M; j += W) {
      Lanes<W> sum = load<W>(&r.a[at(i * M + j)]);
      for (int k = 0; k < K; ++k) sum += Lanes<W>(a(i, k)) * load<W>(&b.a[at(k * M + j)]);
      store(sum, &r.a[at(i * M + j)]);
    }
  }
}

template <int N>
double squared_norm(const Block<N>& a) {
  double sum = 0;
  for (const double v : a.a) sum += v * v;
  return sum;
}

/// One row of A x, without the diagonal's part. Every entry of a block has a sum of its own, so
/// that they run abreast.
template <int N>
[[gnu::always_inline]] inline std::array<double, N> off_product(const BlockMatrix<N>& a,
                                                                const double* x, int row) {
  double sums[N * N] = {};
  for (int e = a.start[at(row)]; e < a.start[at(row) + 1]; ++e) {
    const double* block = a.off[at(e)].a.data();
    const double* y = x + static_cast<std::ptrdiff_t>(N) * a.column[at(e)];
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) sums[N * i + j] += block[N * i + j] * y[j];
    }
  }
  std::array<double, N> s{};
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) s[at(i)] += sums[N * i + j];
  }
  return s;
}

/// One row of A x.
template <int N>
[[gnu::always_inline]] inline std::array<double, N> product(const BlockMatrix<N>& a,
                                                            const double* x, int row) {
  std::array<double, N> s = off_product(a, x, row);
  const Block<N>& d = a.diagonal[at(row)];
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) s[at(i)] += d(i, j) * x[N * row + j];
  }
  return s;
}

/// visit(i, (A x)_i) for every unknown.
template <int N, class Visit>
void for_each_product(const BlockMatrix<N>& a, const double* x, int threads, const Visit& visit) {
  parallel_for(a.rows(), row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      const std::array<double, N> s = product(a, x, row);
      for (int i = 0; i < N; ++i) visit(N * row + i, s[at(i)]);
    }
  });
}

/// r = b − A x
template <int N>
void residual(const BlockMatrix<N>& a, const double* b, const double* x, double* r, int threads) {
  for_each_product(a, x, threads, [&](int i, double ax) { r[i] = b[i] - ax; });
}

/// y = A x
template <int N>
void multiply(const BlockMatrix<N>& a, const double* x, double* y, int threads) {
  for_each_product(a, x, threads, [&](int i, double ax) { y[i] = ax; });
}

}  // namespace sphparam
