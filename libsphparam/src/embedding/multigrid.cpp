#include "embedding/multigrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/parallel.h"

// Levels. Rows are clustered greedily: a row whose strong neighbours are all free gathers them;
// what is left over joins its strongest neighbour. Cluster C with centre c, frame (u, v, c), radius
// r moves its points x by four fields:
//   u × x,  v × x,  c × (x − c)/r,  (c − (c·x)x)/r,
// two turns that carry it along, a turn in its plane, a dilation: P maps their amounts to tangent
// coordinates. Everything is relative to c and r, so that clusters of radius 1e-9 on a limb's tip
// are as well scaled as any. Coarse matrices are PᵀAP; entries keep their places from step to step.
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

template <int N, int K, int M>
Block<N, M> product(const Block<N, K>& a, const Block<K, M>& b) {
  Block<N, M> r;
  for (int i = 0; i < N; ++i) {
    for (int k = 0; k < K; ++k) {
      for (int j = 0; j < M; ++j) r(i, j) += a(i, k) * b(k, j);
    }
  }
  return r;
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
  Matrix m = Eigen::Map<const Matrix>(a.a.data());
  const double trace = m.trace();
  // A mode that the cluster does not have (a single row does not turn) has a zero row.
  for (int i = 0; i < N; ++i) m(i, i) += diagonal_shift * trace + (trace > 0 ? 0 : 1);
  Matrix inverted;
  if constexpr (N <= 4) {
    inverted = m.inverse();
  } else {
    inverted = m.ldlt().solve(Matrix::Identity());
  }
  Block<N> r;
  Eigen::Map<Matrix>(r.a.data()) = inverted;
  return r;
}

/// One row of b − A x, without the diagonal's part.
template <int N>
[[gnu::always_inline]] inline std::array<double, N> off_residual(const BlockMatrix<N>& a, const double* b, const double* x,
                                   int row) {
  std::array<double, N> s;
  for (int i = 0; i < N; ++i) s[at(i)] = b[N * row + i];
  for (int e = a.start[at(row)]; e < a.start[at(row) + 1]; ++e) {
    const Block<N>& block = a.off[at(e)];
    const double* y = x + static_cast<std::ptrdiff_t>(N) * a.column[at(e)];
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) s[at(i)] -= block(i, j) * y[j];
    }
  }
  return s;
}

template <int N>
void relax_row(const BlockMatrix<N>& a, const std::vector<Block<N>>& inverse, const double* b,
               double* x, int row) {
  const std::array<double, N> s = off_residual(a, b, x, row);
  const Block<N>& d = inverse[at(row)];
  for (int i = 0; i < N; ++i) {
    double sum = 0;
    for (int j = 0; j < N; ++j) sum += d(i, j) * s[at(j)];
    x[N * row + i] = sum;
  }
}

template <int N>
void sweep(const BlockMatrix<N>& a, const std::vector<Block<N>>& inverse, const SweepOrder& order,
           const double* b, double* x, bool forward, int threads) {
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
void residual(const BlockMatrix<N>& a, const double* b, const double* x, double* r, int threads) {
  parallel_for(a.rows(), row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      const std::array<double, N> s = off_residual(a, b, x, row);
      const Block<N>& d = a.diagonal[at(row)];
      for (int i = 0; i < N; ++i) {
        double sum = s[at(i)];
        for (int j = 0; j < N; ++j) sum -= d(i, j) * x[N * row + j];
        r[N * row + i] = sum;
      }
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

/// The coarse matrix's pattern; `target`: where each fine off entry goes.
template <int N, int M>
void make_pattern(const BlockMatrix<N>& fine, const std::vector<int>& of_row,
                  const std::vector<int>& start, const std::vector<int>& members,
                  BlockMatrix<M>& coarse, std::vector<int>& target) {
  const int clusters = static_cast<int>(start.size()) - 1;
  target.assign(fine.column.size(), -1);
  coarse.start.assign(1, 0);
  std::vector<int> seen(at(clusters), -1);  // the entry of this row, if it has one
  for (int c = 0; c < clusters; ++c) {
    const int first = coarse.start.back();
    for (int m = start[at(c)]; m < start[at(c) + 1]; ++m) {
      const int row = members[at(m)];
      for (int e = fine.start[at(row)]; e < fine.start[at(row) + 1]; ++e) {
        const int other = of_row[at(fine.column[at(e)])];
        if (other == c || other < 0) continue;
        if (seen[at(other)] < first) {
          seen[at(other)] = static_cast<int>(coarse.column.size());
          coarse.column.push_back(other);
        }
        target[at(e)] = seen[at(other)];
      }
    }
    coarse.start.push_back(static_cast<int>(coarse.column.size()));
  }
  coarse.off.resize(coarse.column.size());
  coarse.diagonal.resize(at(clusters));
}

/// coarse = Pᵀ A P
template <int N, int M>
void restrict_matrix(const BlockMatrix<N>& fine, const std::vector<Block<N, M>>& p,
                     const std::vector<int>& start, const std::vector<int>& members,
                     const std::vector<int>& target, BlockMatrix<M>& coarse, int threads) {
  parallel_for(coarse.rows(), row_grain / 8, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
      std::fill(coarse.off.begin() + coarse.start[at(c)],
                coarse.off.begin() + coarse.start[at(c) + 1], Block<M>{});
      Block<M> diagonal;
      for (int m = start[at(c)]; m < start[at(c) + 1]; ++m) {
        const int row = members[at(m)];
        Block<N, M> within = product(fine.diagonal[at(row)], p[at(row)]);
        for (int e = fine.start[at(row)]; e < fine.start[at(row) + 1]; ++e) {
          const Block<N, M> ap = product(fine.off[at(e)], p[at(fine.column[at(e)])]);
          if (target[at(e)] >= 0) {
            add_transposed_product(p[at(row)], ap, coarse.off[at(target[at(e)])]);
          } else {
            for (size_t i = 0; i < ap.a.size(); ++i) within.a[i] += ap.a[i];
          }
        }
        add_transposed_product(p[at(row)], within, diagonal);
      }
      coarse.diagonal[at(c)] = diagonal;
    }
  });
}

/// b = Pᵀ r
template <int N, int M>
void restrict_vector(const std::vector<Block<N, M>>& p, const std::vector<int>& start,
                     const std::vector<int>& members, const double* r, double* b, int threads) {
  const int clusters = static_cast<int>(start.size()) - 1;
  parallel_for(clusters, row_grain, threads, [&](std::int64_t begin, std::int64_t end) {
    for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
      std::array<double, M> s{};
      for (int m = start[at(c)]; m < start[at(c) + 1]; ++m) {
        const int row = members[at(m)];
        for (int i = 0; i < N; ++i) {
          for (int j = 0; j < M; ++j) s[at(j)] += p[at(row)](i, j) * r[N * row + i];
        }
      }
      for (int j = 0; j < M; ++j) b[M * c + j] = s[at(j)];
    }
  });
}

/// x += P y
template <int N, int M>
void prolong_vector(const std::vector<Block<N, M>>& p, const std::vector<int>& of_row,
                    const double* y, double* x, int threads) {
  parallel_for(static_cast<std::int64_t>(p.size()), row_grain, threads,
               [&](std::int64_t begin, std::int64_t end) {
                 for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
                   const int c = of_row[at(row)];
                   if (c < 0) continue;
                   for (int i = 0; i < N; ++i) {
                     double sum = 0;
                     for (int j = 0; j < M; ++j) sum += p[at(row)](i, j) * y[M * c + j];
                     x[N * row + i] += sum;
                   }
                 }
               });
}

template <int N>
std::vector<Block<N>> inverses(const std::vector<Block<N>>& diagonal, int threads) {
  std::vector<Block<N>> result(diagonal.size());
  parallel_for(static_cast<std::int64_t>(diagonal.size()), row_grain, threads,
               [&](std::int64_t begin, std::int64_t end) {
                 for (std::int64_t i = begin; i < end; ++i) {
                   result[static_cast<size_t>(i)] = inverse(diagonal[static_cast<size_t>(i)]);
                 }
               });
  return result;
}

/// Centre, frame and radius of a cluster of points with radii of their own.
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
  // A single point neither turns nor dilates; its radius is not used.
  site.radius = squares > 0 ? std::sqrt(squares / (last - first)) : 1;
  const TangentFrame frame = tangent_frame(site.centre);
  site.u = frame.u;
  site.v = frame.v;
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
                     const ImagePoint* points, const std::vector<char>& pinned, int threads)
    : matrix_(matrix), order_(order), points_(points), threads_(threads) {
  residual_.resize(2 * at(matrix.rows()));
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
    for (std::vector<double>* x : {&level.b, &level.x, &level.r, &level.first_x}) {
      x->resize(at(modes) * at(level.matrix.rows()));
    }
  }
  factorise_coarsest();
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
  make_pattern(matrix, clusters.of_row, clusters.start, clusters.members, level.matrix,
               clusters.target);
  levels_.push_back(std::move(level));
  return true;
}

void Multigrid::update(const ImagePoint* points) {
  points_ = points;
  fill_first();
  for (size_t l = 1; l < levels_.size(); ++l) fill(l);
  factorise_coarsest();
}

void Multigrid::fill_first() {
  inverse_ = inverses(matrix_.diagonal, threads_);
  Level& coarse = levels_.front();
  const int count = coarse.matrix.rows();
  coarse.sites.resize(at(count));
  prolongation_.assign(at(matrix_.rows()), {});
  parallel_for(count, row_grain, threads_, [&](std::int64_t begin, std::int64_t end) {
    for (int c = static_cast<int>(begin); c < static_cast<int>(end); ++c) {
      const int first = clusters_.start[at(c)], last = clusters_.start[at(c) + 1];
      const Site site = coarse.sites[at(c)] = gather_site<Site>(
          clusters_.members, first, last, [&](int i) { return points_[i].vector(); },
          [](int) { return 0.0; });
      for (int m = first; m < last; ++m) {
        const int row = clusters_.members[at(m)];
        const Vector3 x = points_[row].vector(), d = (x - site.centre) / site.radius;
        const TangentFrame frame = tangent_frame(x);
        const Vector3 fields[modes] = {site.u.cross(x), site.v.cross(x), site.centre.cross(d), -d};
        for (int k = 0; k < modes; ++k) {
          prolongation_[at(row)](0, k) = frame.u.dot(fields[k]);
          prolongation_[at(row)](1, k) = frame.v.dot(fields[k]);
        }
      }
    }
  });
  restrict_matrix(matrix_, prolongation_, clusters_.start, clusters_.members, clusters_.target,
                  coarse.matrix, threads_);
  coarse.inverse = inverses(coarse.matrix.diagonal, threads_);
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
    for (int m = first; m < last; ++m) {
      const Site& child = fine.sites[at(clusters.members[at(m)])];
      Block<modes>& p = fine.prolongation[at(clusters.members[at(m)])];
      p = {};
      // A turn ω of the parent is the turn (ω·u, ω·v, r ω·c) of the child.
      const Vector3 d = (site.centre - child.centre) / site.radius;  // C·u = (C − c)·u
      const double spread = child.radius / site.radius, along = site.centre.dot(child.centre);
      p(0, 0) = site.u.dot(child.u);
      p(1, 0) = site.u.dot(child.v);
      p(2, 0) = -child.radius * site.radius * site.u.dot(d);  // U·c = −U·(C − c)
      p(0, 1) = site.v.dot(child.u);
      p(1, 1) = site.v.dot(child.v);
      p(2, 1) = -child.radius * site.radius * site.v.dot(d);
      p(0, 2) = d.dot(child.u);
      p(1, 2) = d.dot(child.v);
      p(2, 2) = spread * along;
      // The dilation about C carries the child along, (C·u) u + (C·v) v, and dilates it.
      p(0, 3) = -d.dot(child.v);
      p(1, 3) = d.dot(child.u);
      p(3, 3) = spread * along;
    }
  }
  restrict_matrix(fine.matrix, fine.prolongation, clusters.start, clusters.members, clusters.target,
                  coarse.matrix, threads_);
  coarse.inverse = inverses(coarse.matrix.diagonal, threads_);
}

void Multigrid::factorise_coarsest() {
  const BlockMatrix<modes>& a = levels_.back().matrix;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int row, int column, const Block<modes>& block, double shift) {
    for (int i = 0; i < modes; ++i) {
      for (int j = 0; j < modes; ++j) {
        const int r = modes * row + i, c = modes * column + j;
        if (r >= c) entries.emplace_back(r, c, block(i, j) + (r == c ? shift : 0));
      }
    }
  };
  for (int row = 0; row < a.rows(); ++row) {
    const Block<modes>& d = a.diagonal[at(row)];
    double trace = 0;
    for (int i = 0; i < modes; ++i) trace += d(i, i);
    add(row, row, d, trace > 0 ? coarsest_shift * trace : 1);
    for (int e = a.start[at(row)]; e < a.start[at(row) + 1]; ++e) {
      if (a.column[at(e)] < row) add(row, a.column[at(e)], a.off[at(e)], 0);
    }
  }
  Eigen::SparseMatrix<double> matrix(modes * a.rows(), modes * a.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  coarsest_.compute(matrix);
}

/// levels_[l].x = approximately A⁻¹ levels_[l].b
void Multigrid::cycle(size_t l) {
  Level& level = levels_[l];
  const int threads = level.matrix.rows() < least_parallel_rows ? 1 : threads_;
  const auto vector = [](std::vector<double>& v) {
    return Eigen::Map<Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  if (l + 1 == levels_.size()) {
    vector(level.x) = coarsest_.solve(vector(level.b));
    return;
  }
  Level& coarse = levels_[l + 1];
  std::fill(level.x.begin(), level.x.end(), 0.0);
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

void Multigrid::apply(const std::vector<double>& b, std::vector<double>& x) {
  Level& coarse = levels_.front();
  std::fill(x.begin(), x.end(), 0.0);
  sweep(matrix_, inverse_, order_, b.data(), x.data(), true, threads_);
  residual(matrix_, b.data(), x.data(), residual_.data(), threads_);
  restrict_vector(prolongation_, clusters_.start, clusters_.members, residual_.data(),
                  coarse.b.data(), threads_);
  cycle(0);
  prolong_vector(prolongation_, clusters_.of_row, coarse.x.data(), x.data(), threads_);
  sweep(matrix_, inverse_, order_, b.data(), x.data(), false, threads_);
}

namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b, int threads) {
  return parallel_sum(
      static_cast<std::int64_t>(a.size()), threads, [&](std::int64_t first, std::int64_t last) {
        double sum = 0;
        for (auto i = static_cast<size_t>(first); i < static_cast<size_t>(last); ++i) {
          sum += a[i] * b[i];
        }
        return sum;
      });
}

}  // namespace

LinearSolution solve_by_conjugate_gradients(const BlockMatrix<2>& matrix, Multigrid& multigrid,
                                            const std::vector<double>& b, double tolerance,
                                            int most_iterations, int threads) {
  const size_t n = b.size();
  const std::vector<double> zero(n, 0.0);
  LinearSolution solution{std::vector<double>(n, 0.0)};
  std::vector<double> r = b, z(n), direction, image(n);
  multigrid.apply(r, z);
  double rz = dot(r, z, threads);
  const double enough = tolerance * tolerance * rz;
  direction = z;
  while (solution.iterations < most_iterations && rz > enough) {
    residual(matrix, zero.data(), direction.data(), image.data(), threads);  // −A d
    const double curvature = -dot(direction, image, threads);
    if (!(curvature > 0)) break;
    const double step = rz / curvature;
    for (size_t i = 0; i < n; ++i) solution.x[i] += step * direction[i];
    for (size_t i = 0; i < n; ++i) r[i] += step * image[i];
    ++solution.iterations;
    if (solution.iterations == most_iterations) break;
    multigrid.apply(r, z);
    const double next = dot(r, z, threads);
    for (size_t i = 0; i < n; ++i) direction[i] = z[i] + next / rz * direction[i];
    rz = next;
  }
  return solution;
}

}  // namespace sphparam
