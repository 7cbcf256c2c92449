#include "embedding/multigrid.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/parallel.h"

// Levels. Rows are clustered greedily: a row whose strong neighbours are all free gathers them;
// what is left over joins its strongest neighbour. Cluster C with centre c, frame (u, v, c), radius
// r moves its points x by four fields:
//   r u × x,  r v × x,  c × x,  c − x,
// two turns that carry it along, a turn in its plane, a dilation: P maps their amounts to tangent
// coordinates. Everything is relative to c and r, so that clusters of radius 1e-9 on a limb's tip
// are as well scaled as any, and entries are near 1. Coarse matrices are PᵀAP.
// The V-cycle: forward sweep, coarse correction of the residual, backward sweep. Unsmoothed
// clusters correct too little, hence a second visit of the coarser levels (they are tiny).

namespace sphparam {
namespace {

constexpr double strong = 0.05;     // |A_ij| ≥ this · √(|A_ii||A_jj|)
constexpr int coarsest_rows = 100;  // solved directly
constexpr double least_shrinkage = 0.8;
constexpr int sweep_block = 512;                                 // rows
constexpr double diagonal_shift = 1e-10, coarsest_shift = 1e-8;  // of a block's trace
constexpr std::int64_t row_grain = 2048;
constexpr int least_parallel_rows = 4096;  // below it waking the other threads costs more

size_t at(int i) { return static_cast<size_t>(i); }

/// r += a b
template <int N, int K, int M>
void add_product(const Block<N, K>& a, const Block<K, M>& b, Block<N, M>& r) {
  for (int i = 0; i < N; ++i) {
    for (int k = 0; k < K; ++k) {
      for (int j = 0; j < M; ++j) r(i, j) += a(i, k) * b(k, j);
    }
  }
}

/// r += aᵀ b
template <int N, int K, int M>
void add_transposed_product(const Block<K, N>& a, const Block<K, M>& b, Block<N, M>& r) {
  for (int k = 0; k < K; ++k) {
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < M; ++j) r(i, j) += a(k, i) * b(k, j);
    }
  }
}

template <int N>
double squared_norm(const Block<N>& a) {
  double sum = 0;
  for (const double v : a.a) sum += v * v;
  return sum;
}

template <int N>
Block<N> inverse(const Block<N>& a) {
  using Matrix = Eigen::Matrix<double, N, N, Eigen::RowMajor>;
  Matrix m = Eigen::Map<const Eigen::Matrix<float, N, N, Eigen::RowMajor>>(a.a.data())
                 .template cast<double>();
  const double trace = m.trace();
  // A mode that the cluster does not have (a single row does not turn) has a zero row.
  for (int i = 0; i < N; ++i) m(i, i) += diagonal_shift * trace + (trace > 0 ? 0 : 1);
  Block<N> r;
  Eigen::Map<Eigen::Matrix<float, N, N, Eigen::RowMajor>>(r.a.data()) =
      m.inverse().template cast<float>();
  return r;
}

/// One row of A x, without the diagonal's part. Every entry of a block has a sum of its own, so
/// that they run abreast. `Number`: of the sums.
template <class Number, int N>
[[gnu::always_inline]] inline std::array<Number, N> off_product(const BlockMatrix<N>& a,
                                                                const float* x, int row) {
  Number sums[N * N] = {};
  for (int e = a.start[at(row)]; e < a.start[at(row) + 1]; ++e) {
    const float* block = a.off[at(e)].a.data();
    const float* y = x + static_cast<std::ptrdiff_t>(N) * a.column[at(e)];
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) sums[N * i + j] += static_cast<Number>(block[N * i + j]) * y[j];
    }
  }
  std::array<Number, N> s{};
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) s[at(i)] += sums[N * i + j];
  }
  return s;
}

/// One row of A x. In doubles: of a smooth x little is left, and were that lost in rounding,
/// conjugate gradients would meet curvatures below zero.
template <int N>
[[gnu::always_inline]] inline std::array<double, N> product(const BlockMatrix<N>& a, const float* x,
                                                            int row) {
  std::array<double, N> s = off_product<double>(a, x, row);
  const Block<N>& d = a.diagonal[at(row)];
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) s[at(i)] += static_cast<double>(d(i, j)) * x[N * row + j];
  }
  return s;
}

/// What the row's own unknowns would have to make of the others' work.
template <int N>
[[gnu::always_inline]] inline std::array<float, N> off_residual(const BlockMatrix<N>& a,
                                                                const float* b, const float* x,
                                                                int row) {
  std::array<float, N> s = off_product<float>(a, x, row);
  for (int i = 0; i < N; ++i) s[at(i)] = b[N * row + i] - s[at(i)];
  return s;
}

/// The diagonal's inverse is stored for large blocks, …
template <int N>
[[gnu::always_inline]] inline void relax_row(const BlockMatrix<N>& a,
                                             const std::vector<Block<N>>& inverse, const float* b,
                                             float* x, int row) {
  const std::array<float, N> s = off_residual(a, b, x, row);
  const Block<N>& d = inverse[at(row)];
  for (int i = 0; i < N; ++i) {
    float sum = 0;
    for (int j = 0; j < N; ++j) sum += d(i, j) * s[at(j)];
    x[N * row + i] = sum;
  }
}

/// … and computed where it is needed for small ones: a product of floats is exact in double.
struct SmallInverses {};
[[gnu::always_inline]] inline void relax_row(const BlockMatrix<2>& a, SmallInverses, const float* b,
                                             float* x, int row) {
  const std::array<float, 2> s = off_residual(a, b, x, row);
  const Block<2>& d = a.diagonal[at(row)];
  const double shift = diagonal_shift * (static_cast<double>(d(0, 0)) + d(1, 1));
  const double d0 = d(0, 0) + shift, d1 = d(1, 1) + shift, off = d(0, 1);
  const double scale = 1 / (d0 * d1 - off * off);
  // Rounded before the rows before this one are needed: that is what a sweep waits for.
  const float i0 = static_cast<float>(scale * d1), i1 = static_cast<float>(scale * d0);
  const float i01 = static_cast<float>(scale * off);
  x[2 * row] = i0 * s[0] - i01 * s[1];
  x[2 * row + 1] = i1 * s[1] - i01 * s[0];
}

template <int N, class Inverses>
void sweep(const BlockMatrix<N>& a, const Inverses& inverse, const SweepOrder& order,
           const float* b, float* x, bool forward, int threads) {
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

/// r = b − A x
template <int N>
void residual(const BlockMatrix<N>& a, const float* b, const float* x, float* r, int threads) {
  parallel_for(a.rows(), row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      const std::array<double, N> s = product(a, x, row);
      for (int i = 0; i < N; ++i) r[N * row + i] = static_cast<float>(b[N * row + i] - s[at(i)]);
    }
  });
}

/// y = A x
template <int N>
void multiply(const BlockMatrix<N>& a, const float* x, float* y, int threads) {
  parallel_for(a.rows(), row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      const std::array<double, N> s = product(a, x, row);
      for (int i = 0; i < N; ++i) y[N * row + i] = static_cast<float>(s[at(i)]);
    }
  });
}

/// Of each row: its cluster, −1 where pinned; and the number of clusters.
template <int N>
std::pair<std::vector<int>, int> cluster(const BlockMatrix<N>& a, const std::vector<char>& pinned,
                                         double strength) {
  const int n = a.rows();
  std::vector<double> norm(at(n));
  for (int i = 0; i < n; ++i) norm[at(i)] = std::sqrt(squared_norm(a.diagonal[at(i)]));
  const auto is_strong = [&](int i, int e) {
    return squared_norm(a.off[at(e)]) >
           strength * strength * norm[at(i)] * norm[at(a.column[at(e)])];
  };
  const auto is_pinned = [&](int i) { return !pinned.empty() && pinned[at(i)]; };
  std::vector<int> of_row(at(n), -1);
  int clusters = 0;
  for (int i = 0; i < n; ++i) {
    if (of_row[at(i)] >= 0 || is_pinned(i)) continue;
    bool free = true;
    int found = 0;
    for (int e = a.start[at(i)]; free && e < a.start[at(i) + 1]; ++e) {
      if (!is_strong(i, e)) continue;
      ++found;
      free = of_row[at(a.column[at(e)])] < 0;
    }
    if (!free || found == 0) continue;
    of_row[at(i)] = clusters;
    for (int e = a.start[at(i)]; e < a.start[at(i) + 1]; ++e) {
      if (is_strong(i, e)) of_row[at(a.column[at(e)])] = clusters;
    }
    ++clusters;
  }
  // Rows left over join the cluster of their strongest neighbour, if one has a cluster by now.
  const std::vector<int> cores = of_row;
  for (int i = 0; i < n; ++i) {
    if (of_row[at(i)] >= 0 || is_pinned(i)) continue;
    double strongest = 0;
    for (int e = a.start[at(i)]; e < a.start[at(i) + 1]; ++e) {
      const int j = a.column[at(e)];
      const double connection = squared_norm(a.off[at(e)]) / norm[at(j)];
      if (cores[at(j)] < 0 || !(connection > strongest)) continue;
      strongest = connection;
      of_row[at(i)] = cores[at(j)];
    }
    if (of_row[at(i)] < 0) of_row[at(i)] = clusters++;
  }
  return {std::move(of_row), clusters};
}

/// Rows by cluster.
void list_members(const std::vector<int>& of_row, int clusters, std::vector<int>& start,
                  std::vector<int>& members) {
  start.assign(at(clusters) + 1, 0);
  for (const int c : of_row) {
    if (c >= 0) ++start[at(c) + 1];
  }
  for (size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  members.resize(at(start.back()));
  std::vector<int> place(start.begin(), start.end() - 1);
  for (size_t row = 0; row < of_row.size(); ++row) {
    if (of_row[row] >= 0) members[at(place[at(of_row[row])]++)] = static_cast<int>(row);
  }
}

/// The coarse matrix's pattern, columns in order.
template <int N, int M>
void make_pattern(const BlockMatrix<N>& fine, const std::vector<int>& of_row,
                  const std::vector<int>& start, const std::vector<int>& members,
                  BlockMatrix<M>& coarse) {
  const int clusters = static_cast<int>(start.size()) - 1;
  coarse.start.assign(1, 0);
  coarse.start.reserve(start.size());
  std::vector<int> seen(at(clusters), -1);  // the last row that had it
  for (int c = 0; c < clusters; ++c) {
    for (int m = start[at(c)]; m < start[at(c) + 1]; ++m) {
      const int row = members[at(m)];
      for (int e = fine.start[at(row)]; e < fine.start[at(row) + 1]; ++e) {
        const int other = of_row[at(fine.column[at(e)])];
        if (other == c || other < 0 || std::exchange(seen[at(other)], c) == c) continue;
        coarse.column.push_back(other);
      }
    }
    std::sort(coarse.column.begin() + coarse.start.back(), coarse.column.end());
    coarse.start.push_back(static_cast<int>(coarse.column.size()));
  }
  coarse.off.resize(coarse.column.size());
  coarse.diagonal.resize(at(clusters));
}

/// Row c of PᵀAP.
template <int N, int M>
void restrict_row(const BlockMatrix<N>& fine, const std::vector<Block<N, M>>& p,
                  const std::vector<int>& of_row, std::span<const int> members,
                  BlockMatrix<M>& coarse, int c) {
  const auto first = coarse.column.begin() + coarse.start[at(c)];
  const auto last = coarse.column.begin() + coarse.start[at(c) + 1];
  Block<M>* const off = coarse.off.data() + coarse.start[at(c)];
  std::fill(off, off + (last - first), Block<M>{});
  Block<M> diagonal;
  int known = -1;  // the cluster looked up last: neighbours in a row are often of the same
  std::ptrdiff_t place = 0;
  for (const int row : members) {
    Block<N, M> within;
    add_product(fine.diagonal[at(row)], p[at(row)], within);
    for (int e = fine.start[at(row)]; e < fine.start[at(row) + 1]; ++e) {
      const int column = fine.column[at(e)], other = of_row[at(column)];
      if (other == c || other < 0) {
        add_product(fine.off[at(e)], p[at(column)], within);
        continue;
      }
      if (std::exchange(known, other) != other) {
        place = std::lower_bound(first, last, other) - first;
      }
      Block<N, M> ap;
      add_product(fine.off[at(e)], p[at(column)], ap);
      add_transposed_product(p[at(row)], ap, off[place]);
    }
    add_transposed_product(p[at(row)], within, diagonal);
  }
  coarse.diagonal[at(c)] = diagonal;
}

/// coarse = Pᵀ A P
template <int N, int M>
void restrict_matrix(const BlockMatrix<N>& fine, const std::vector<Block<N, M>>& p,
                     const std::vector<int>& of_row, const std::vector<int>& start,
                     const std::vector<int>& members, BlockMatrix<M>& coarse, int threads) {
  parallel_for(coarse.rows(), row_grain / 8, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
      const std::span<const int> rows(&members[at(start[at(c)])],
                                      at(start[at(c) + 1] - start[at(c)]));
      restrict_row(fine, p, of_row, rows, coarse, c);
    }
  });
}

/// b = Pᵀ r
template <int N>
void restrict_vector(const std::vector<Block<N>>& p, const std::vector<int>& start,
                     const std::vector<int>& members, const float* r, float* b, int threads) {
  const int clusters = static_cast<int>(start.size()) - 1;
  parallel_for(clusters, row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
      std::array<float, N> s{};
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
void prolong_vector(const std::vector<Block<N>>& p, const std::vector<int>& of_row, const float* y,
                    float* x, int threads) {
  parallel_for(static_cast<std::int64_t>(p.size()), row_grain, threads,
               [&](std::int64_t begin, std::int64_t end) {
                 for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
                   const int c = of_row[at(row)];
                   for (int i = 0; i < N; ++i) {
                     float sum = 0;
                     for (int j = 0; j < N; ++j) sum += p[at(row)](i, j) * y[N * c + j];
                     x[N * row + i] += sum;
                   }
                 }
               });
}

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

/// Centre and radius of a cluster of points with radii of their own.
template <class Site, class Centre, class Radius>
Site gather_site(const std::vector<int>& members, int first, int last, const Centre& centre,
                 const Radius& radius) {
  Site site;
  Vector3 sum = Vector3::Zero();
  for (int m = first; m < last; ++m) sum += centre(members[at(m)]);
  site.centre = sum.stableNormalized();
  double squares = 0;
  for (int m = first; m < last; ++m) {
    const double r = radius(members[at(m)]);
    squares += (centre(members[at(m)]) - site.centre).squaredNorm() + r * r;
  }
  site.radius = std::sqrt(squares / (last - first));
  return site;
}

}  // namespace

SweepOrder order_sweeps(const std::vector<int>& start, const std::vector<int>& column, int size) {
  const int rows = static_cast<int>(start.size()) - 1, blocks = (rows + size - 1) / size;
  SweepOrder order;
  for (int b = 0; b < blocks; ++b) order.first_row.push_back(b * size);
  order.first_row.push_back(rows);
  std::vector<int> colour(at(blocks), -1), taken;  // taken[c]: last block that found c taken
  for (int b = 0; b < blocks; ++b) {
    for (int e = start[at(order.first_row[at(b)])]; e < start[at(order.first_row[at(b) + 1])];
         ++e) {
      const int c = colour[at(column[at(e)] / size)];
      if (c >= 0) taken[at(c)] = b;
    }
    const auto free = std::find_if(taken.begin(), taken.end(), [&](int t) { return t != b; });
    colour[at(b)] = static_cast<int>(free - taken.begin());
    if (free == taken.end()) taken.push_back(-1);
  }
  order.colour_start.push_back(0);
  for (int c = 0; c < static_cast<int>(taken.size()); ++c) {
    for (int b = 0; b < blocks; ++b) {
      if (colour[at(b)] == c) order.blocks.push_back(b);
    }
    order.colour_start.push_back(static_cast<int>(order.blocks.size()));
  }
  return order;
}

Multigrid::Multigrid(const BlockMatrix<2>& matrix, const SweepOrder& order,
                     const ImagePoint* points, const float* units, const std::vector<char>& pinned,
                     int threads)
    : matrix_(matrix), order_(order), points_(points), units_(units), threads_(threads) {
  coarsen(matrix_, pinned, clusters_);
  fill_first();
  while (levels_.back().matrix.rows() > coarsest_rows) {
    Clusters clusters;
    if (!coarsen(levels_.back().matrix, {}, clusters)) break;
    levels_[levels_.size() - 2].clusters = std::move(clusters);
    fill(levels_.size() - 1);
  }
  for (Level& level : levels_) {
    level.order = order_sweeps(level.matrix.start, level.matrix.column, sweep_block);
    for (Unknowns* x : {&level.b, &level.x, &level.r, &level.first_x}) {
      x->resize(at(modes) * at(level.matrix.rows()));
    }
  }
  const Eigen::SparseMatrix<double> coarsest = coarsest_matrix();
  coarsest_.analyzePattern(coarsest);
  coarsest_.factorize(coarsest);
}

/// Appends a level with the pattern of the matrix's clusters. False: the matrix does not coarsen.
template <int N>
bool Multigrid::coarsen(const BlockMatrix<N>& matrix, const std::vector<char>& pinned,
                        Clusters& clusters) {
  int count = 0;
  for (const double strength : {strong, 0.0}) {
    std::tie(clusters.of_row, count) = cluster(matrix, pinned, strength);
    if (count <= least_shrinkage * matrix.rows()) break;
  }
  if (count > least_shrinkage * matrix.rows() && !levels_.empty()) return false;
  list_members(clusters.of_row, count, clusters.start, clusters.members);
  Level level;
  make_pattern(matrix, clusters.of_row, clusters.start, clusters.members, level.matrix);
  levels_.push_back(std::move(level));
  return true;
}

void Multigrid::update(const ImagePoint* points) {
  points_ = points;
  fill_first();
  for (size_t l = 1; l < levels_.size(); ++l) fill(l);
  coarsest_.factorize(coarsest_matrix());
}

void Multigrid::fill_first() {
  Level& coarse = levels_.front();
  const int count = coarse.matrix.rows();
  coarse.sites.resize(at(count));
  parallel_for(count, row_grain, threads_, [&](std::int64_t begin, std::int64_t end) {
    for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
      coarse.sites[at(c)] = gather_site<Site>(
          clusters_.members, clusters_.start[at(c)], clusters_.start[at(c) + 1],
          [&](int i) { return points_[i].vector(); },
          [&](int i) { return static_cast<double>(units_[i]); });
    }
  });
  restrict_matrix(matrix_, first_prolongation(), clusters_.of_row, clusters_.start,
                  clusters_.members, coarse.matrix, threads_);
  invert(coarse.matrix.diagonal, coarse.inverse, threads_);
}

// With τ = a u + b v the tangent vector of coordinates (a, b) at x and ω = x × τ = a v − b u, the
// four fields have the products  r U·ω,  r V·ω,  (c − x)·ω,  (c − x)·τ  with τ.

std::vector<Block<2, Multigrid::modes>> Multigrid::first_prolongation() const {
  std::vector<Block<2, modes>> p(at(matrix_.rows()));
  const std::vector<Site>& sites = levels_.front().sites;
  parallel_for(matrix_.rows(), row_grain, threads_, [&](std::int64_t begin, std::int64_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      if (clusters_.of_row[at(row)] < 0) continue;
      const Site& site = sites[at(clusters_.of_row[at(row)])];
      const Vector3 x = points_[row].vector(), d = site.centre - x;
      const TangentFrame own = tangent_frame(x), frame = tangent_frame(site.centre);
      const double radius = site.radius;
      const double at_u[modes] = {radius * frame.u.dot(own.v), radius * frame.v.dot(own.v),
                                  d.dot(own.v), d.dot(own.u)};
      const double at_v[modes] = {-radius * frame.u.dot(own.u), -radius * frame.v.dot(own.u),
                                  -d.dot(own.u), d.dot(own.v)};
      for (int k = 0; k < modes; ++k) {
        p[at(row)](0, k) = static_cast<float>(at_u[k] / units_[row]);
        p[at(row)](1, k) = static_cast<float>(at_v[k] / units_[row]);
      }
    }
  });
  return p;
}

/// b = Pᵀ r
void Multigrid::restrict_first(const float* r, float* b) const {
  const std::vector<Site>& sites = levels_.front().sites;
  parallel_for(std::ssize(sites), row_grain, threads_, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<size_t>(begin); c < static_cast<size_t>(end); ++c) {
      const Site& site = sites[c];
      Vector3 turn = Vector3::Zero();
      double spin = 0, dilation = 0;
      for (int m = clusters_.start[c]; m < clusters_.start[c + 1]; ++m) {
        const int row = clusters_.members[at(m)];
        const Vector3 x = points_[row].vector(), d = site.centre - x;
        const TangentFrame own = tangent_frame(x);
        const double s = 1.0 / units_[row], along_u = s * r[2 * row], along_v = s * r[2 * row + 1];
        const Vector3 omega = along_u * own.v - along_v * own.u;
        turn += omega;
        spin += d.dot(omega);
        dilation += d.dot(along_u * own.u + along_v * own.v);
      }
      const TangentFrame frame = tangent_frame(site.centre);
      b[modes * c] = static_cast<float>(site.radius * frame.u.dot(turn));
      b[modes * c + 1] = static_cast<float>(site.radius * frame.v.dot(turn));
      b[modes * c + 2] = static_cast<float>(spin);
      b[modes * c + 3] = static_cast<float>(dilation);
    }
  });
}

/// x += P y
void Multigrid::prolong_first(const float* y, float* x) const {
  const std::vector<Site>& sites = levels_.front().sites;
  parallel_for(std::ssize(sites), row_grain, threads_, [&](std::int64_t begin, std::int64_t end) {
    for (auto c = static_cast<size_t>(begin); c < static_cast<size_t>(end); ++c) {
      const Site& site = sites[c];
      const float* amounts = y + modes * c;
      const TangentFrame frame = tangent_frame(site.centre);
      const Vector3 turn = site.radius * (amounts[0] * frame.u + amounts[1] * frame.v);
      for (int m = clusters_.start[c]; m < clusters_.start[c + 1]; ++m) {
        const int row = clusters_.members[at(m)];
        const Vector3 point = points_[row].vector(), d = site.centre - point;
        const TangentFrame own = tangent_frame(point);
        const Vector3 omega = turn + amounts[2] * d, away = amounts[3] * d;
        const double s = 1.0 / units_[row];
        x[2 * row] += static_cast<float>(s * (omega.dot(own.v) + away.dot(own.u)));
        x[2 * row + 1] += static_cast<float>(s * (away.dot(own.v) - omega.dot(own.u)));
      }
    }
  });
}

void Multigrid::fill(size_t l) {
  Level &fine = levels_[l - 1], &coarse = levels_[l];
  const Clusters& clusters = fine.clusters;
  const int count = coarse.matrix.rows();
  coarse.sites.resize(at(count));
  fine.prolongation.resize(at(fine.matrix.rows()));
  for (int c = 0; c < count; ++c) {
    const int first = clusters.start[at(c)], last = clusters.start[at(c) + 1];
    const Site site = coarse.sites[at(c)] = gather_site<Site>(
        clusters.members, first, last, [&](int i) { return fine.sites[at(i)].centre; },
        [&](int i) { return fine.sites[at(i)].radius; });
    const TangentFrame frame = tangent_frame(site.centre);
    for (int m = first; m < last; ++m) {
      const Site& child = fine.sites[at(clusters.members[at(m)])];
      const TangentFrame own = tangent_frame(child.centre);
      // A turn ω of the parent is the turn (ω·u/r, ω·v/r, ω·c) of the child.
      const Vector3 d = site.centre - child.centre;  // C·u = d·u, U·c = −U·d
      const double s = 1 / child.radius, larger = site.radius * s;
      const double along = site.centre.dot(child.centre);
      const auto set = [&](int i, int j, double value) {
        fine.prolongation[at(clusters.members[at(m)])](i, j) = static_cast<float>(value);
      };
      set(0, 0, larger * frame.u.dot(own.u));
      set(1, 0, larger * frame.u.dot(own.v));
      set(2, 0, -site.radius * frame.u.dot(d));
      set(0, 1, larger * frame.v.dot(own.u));
      set(1, 1, larger * frame.v.dot(own.v));
      set(2, 1, -site.radius * frame.v.dot(d));
      set(0, 2, s * d.dot(own.u));
      set(1, 2, s * d.dot(own.v));
      set(2, 2, along);
      // The dilation about C carries the child along, (d·u) u + (d·v) v, and dilates it.
      set(0, 3, -s * d.dot(own.v));
      set(1, 3, s * d.dot(own.u));
      set(3, 3, along);
    }
  }
  restrict_matrix(fine.matrix, fine.prolongation, clusters.of_row, clusters.start, clusters.members,
                  coarse.matrix, threads_);
  invert(coarse.matrix.diagonal, coarse.inverse, threads_);
}

/// The lower triangle, shifted. Columns of the rows are in order, so that it is written in one go.
Eigen::SparseMatrix<double> Multigrid::coarsest_matrix() const {
  const BlockMatrix<modes>& a = levels_.back().matrix;
  Eigen::SparseMatrix<double> matrix(modes * a.rows(), modes * a.rows());
  matrix.reserve(std::ssize(a.off) * modes * modes / 2 + a.rows() * modes * (modes + 1) / 2);
  for (int row = 0; row < a.rows(); ++row) {
    const Block<modes>& d = a.diagonal[at(row)];
    double trace = 0;
    for (int i = 0; i < modes; ++i) trace += d(i, i);
    const double shift = trace > 0 ? coarsest_shift * trace : 1;
    for (int i = 0; i < modes; ++i) {
      matrix.startVec(modes * row + i);
      for (int j = i; j < modes; ++j) {
        matrix.insertBack(modes * row + j, modes * row + i) = d(i, j) + (i == j ? shift : 0);
      }
      for (int e = a.start[at(row)]; e < a.start[at(row) + 1]; ++e) {
        if (a.column[at(e)] < row) continue;
        for (int j = 0; j < modes; ++j) {
          matrix.insertBack(modes * a.column[at(e)] + j, modes * row + i) = a.off[at(e)](i, j);
        }
      }
    }
  }
  matrix.finalize();
  return matrix;
}

/// levels_[l].x = approximately A⁻¹ levels_[l].b
void Multigrid::cycle(size_t l) {
  Level& level = levels_[l];
  const int threads = level.matrix.rows() < least_parallel_rows ? 1 : threads_;
  const auto vector = [](Unknowns& v) {
    return Eigen::Map<Eigen::VectorXf>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  if (l + 1 == levels_.size()) {
    // Where it has no factor, what comes down from finer levels stays as their sweeps left it.
    if (coarsest_.info() == Eigen::Success) {
      vector(level.x) = coarsest_.solve(vector(level.b).cast<double>()).cast<float>();
    } else {
      vector(level.x).setZero();
    }
    return;
  }
  Level& coarse = levels_[l + 1];
  std::fill(level.x.begin(), level.x.end(), 0.0F);
  sweep(level.matrix, level.inverse, level.order, level.b.data(), level.x.data(), true, threads);
  residual(level.matrix, level.b.data(), level.x.data(), level.r.data(), threads);
  restrict_vector(level.prolongation, level.clusters.start, level.clusters.members, level.r.data(),
                  coarse.b.data(), threads);
  cycle(l + 1);
  if (l + 2 < levels_.size()) {
    coarse.first_x = coarse.x;
    residual(coarse.matrix, coarse.b.data(), coarse.x.data(), coarse.r.data(), threads);
    coarse.b.swap(coarse.r);
    cycle(l + 1);
    vector(coarse.x) += vector(coarse.first_x);
  }
  prolong_vector(level.prolongation, level.clusters.of_row, coarse.x.data(), level.x.data(),
                 threads);
  sweep(level.matrix, level.inverse, level.order, level.b.data(), level.x.data(), false, threads);
}

void Multigrid::apply(const Unknowns& b, Unknowns& x, Unknowns& rest) {
  std::fill(x.begin(), x.end(), 0.0F);
  sweep(matrix_, SmallInverses{}, order_, b.data(), x.data(), true, threads_);
  residual(matrix_, b.data(), x.data(), rest.data(), threads_);
  restrict_first(rest.data(), levels_.front().b.data());
  cycle(0);
  prolong_first(levels_.front().x.data(), x.data());
  sweep(matrix_, SmallInverses{}, order_, b.data(), x.data(), false, threads_);
}

namespace {

double dot(const Unknowns& a, const Unknowns& b, int threads) {
  return parallel_sum(
      static_cast<std::int64_t>(a.size()), threads, [&](std::int64_t first, std::int64_t last) {
        double sum = 0;
        for (auto i = static_cast<size_t>(first); i < static_cast<size_t>(last); ++i) {
          sum += static_cast<double>(a[i]) * b[i];
        }
        return sum;
      });
}

/// a += factor · b
void add(Unknowns& a, double factor, const Unknowns& b) {
  const float f = static_cast<float>(factor);
  for (size_t i = 0; i < a.size(); ++i) a[i] += f * b[i];
}

}  // namespace

LinearSolution solve_by_conjugate_gradients(const BlockMatrix<2>& matrix, Multigrid& multigrid,
                                            Unknowns r, double tolerance, int most_iterations,
                                            int threads) {
  const size_t n = r.size();
  LinearSolution solution{Unknowns(n, 0.0F)};
  Unknowns z(n), direction(n, 0.0F), image(n);
  double rz = 0, enough = 0;
  for (;;) {
    multigrid.apply(r, z, image);
    const double next = dot(r, z, threads);
    if (solution.iterations == 0) enough = tolerance * tolerance * next;
    const float share = rz > 0 ? static_cast<float>(next / rz) : 0.0F;
    for (size_t i = 0; i < n; ++i) direction[i] = z[i] + share * direction[i];
    rz = next;
    if (solution.iterations > 0 && !(rz > enough)) break;
    multiply(matrix, direction.data(), image.data(), threads);
    const double curvature = dot(direction, image, threads);
    if (!(curvature > 0)) break;
    add(solution.x, rz / curvature, direction);
    add(r, -rz / curvature, image);
    solution.gain += rz * rz / curvature;  // b·d = r·z: directions are conjugate
    if (++solution.iterations == most_iterations) break;
  }
  return solution;
}

}  // namespace sphparam
