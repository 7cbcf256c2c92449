#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "embedding/multigrid/aggregates.h"
#include "embedding/multigrid/block_matrix.h"
#include "lanes.h"
#include "sphparam/parallel.h"

// What P carries between a matrix and that of its aggregates: block `row` of P maps the unknowns of
// the row's aggregate to those of the row, and is zero elsewhere.

namespace sphparam {

/// The coarse matrix's pattern, columns in order; entries zero.
template <int N, int M>
void make_pattern(const BlockMatrix<N>& fine, const Aggregates& aggregates,
                  BlockMatrix<M>& coarse) {
  coarse.start.assign(1, 0);
  coarse.start.reserve(aggregates.start.size());
  std::vector<int> seen(at(aggregates.count()), -1);  // the last row that had it
  for (int c = 0; c < aggregates.count(); ++c) {
    for (int m = aggregates.start[at(c)]; m < aggregates.start[at(c) + 1]; ++m) {
      const int row = aggregates.members[at(m)];
      for (int e = fine.start[at(row)]; e < fine.start[at(row) + 1]; ++e) {
        const int other = aggregates.of_row[at(fine.column[at(e)])];
        if (other == c || other < 0 || std::exchange(seen[at(other)], c) == c) continue;
        coarse.column.push_back(other);
      }
    }
    std::sort(coarse.column.begin() + coarse.start.back(), coarse.column.end());
    coarse.start.push_back(static_cast<int>(coarse.column.size()));
  }
  coarse.off.resize(coarse.column.size());
  coarse.diagonal.resize(at(aggregates.count()));
}

/// Row c of PᵀAP, W columns of a block at a time.
template <int W, int N, int M>
SPHPARAM_INLINE void restrict_row(const BlockMatrix<N>& fine, const std::vector<Block<N, M>>& p,
                                  const std::vector<int>& of_row, std::span<const int> members,
                                  BlockMatrix<M>& coarse, int c) {
  const auto first = coarse.column.begin() + coarse.start[at(c)];
  const auto last = coarse.column.begin() + coarse.start[at(c) + 1];
  Block<M>* const off = coarse.off.data() + coarse.start[at(c)];
  std::fill(off, off + (last - first), Block<M>{});
  Block<M> diagonal;
  int known = -1;  // the aggregate looked up last: neighbours in a row are often of the same
  std::ptrdiff_t place = 0;
  for (const int row : members) {
    Block<N, M> within;
    add_product<W>(fine.diagonal[at(row)], p[at(row)], within);
    for (int e = fine.start[at(row)]; e < fine.start[at(row) + 1]; ++e) {
      const int column = fine.column[at(e)], other = of_row[at(column)];
      if (other == c || other < 0) {
        add_product<W>(fine.off[at(e)], p[at(column)], within);
        continue;
      }
      if (std::exchange(known, other) != other) {
        place = std::lower_bound(first, last, other) - first;
      }
      Block<N, M> ap;
      add_product<W>(fine.off[at(e)], p[at(column)], ap);
      add_product<W>(transposed(p[at(row)]), ap, off[place]);
    }
    add_product<W>(transposed(p[at(row)]), within, diagonal);
  }
  coarse.diagonal[at(c)] = diagonal;
}

/// coarse = Pᵀ A P, in the pattern that it has.
template <int N, int M>
void restrict_matrix(const BlockMatrix<N>& fine, const std::vector<Block<N, M>>& p,
                     const Aggregates& aggregates, BlockMatrix<M>& coarse, int threads) {
  parallel_for(coarse.rows(), row_grain / 8, threads, [&](std::int64_t begin, std::int64_t end) {
    run_on_lanes([&]<int Widest>(Width<Widest>) SPHPARAM_INLINED {
      for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
        const int first = aggregates.start[at(c)], last = aggregates.start[at(c) + 1];
        const std::span<const int> rows(&aggregates.members[at(first)], at(last - first));
        restrict_row<std::min(Widest, M)>(fine, p, aggregates.of_row, rows, coarse, c);
      }
    });
  });
}

/// b = Pᵀ r
template <int N>
void restrict_vector(const std::vector<Block<N>>& p, const Aggregates& aggregates, const double* r,
                     double* b, int threads) {
  const std::vector<int>&start = aggregates.start, &members = aggregates.members;
  parallel_for(aggregates.count(), row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
      std::array<double, N> s{};
      for (int m = start[at(c)]; m < start[at(c) + 1]; ++m) {
        const int row = members[at(m)];
        for (int i = 0; i < N; ++i) {
          for (int j = 0; j < N; ++j) s[at(j)] += p[at(row)](i, j) * r[N * row + i];
        }
      }
      for (int j = 0; j < N; ++j) b[N * c + j] = s[at(j)];
    }
  });
}

/// x += P y
template <int N>
void prolong_vector(const std::vector<Block<N>>& p, const std::vector<int>& of_row, const double* y,
                    double* x, int threads) {
  parallel_for(static_cast<std::int64_t>(p.size()), row_grain, threads,
               [&](std::int64_t begin, std::int64_t end) {
                 for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
                   const int c = of_row[at(row)];
                   for (int i = 0; i < N; ++i) {
                     double sum = 0;
                     for (int j = 0; j < N; ++j) sum += p[at(row)](i, j) * y[N * c + j];
                     x[N * row + i] += sum;
                   }
                 }
               });
}

}  // namespace sphparam
