#include "embedding/multigrid/multigrid.h"

#include <algorithm>
#include <utility>

#include "embedding/multigrid/coarse_matrix.h"

// Levels: rows by strong connections (aggregates.h), which move by a few modes
// (near_nullspace.cpp), and coarse matrices PᵀAP (coarse_matrix.h), until the matrix is small
// enough for a factorisation. The V-cycle: forward sweep (block_gauss_seidel.h), coarse correction
// of the residual, backward sweep. Unsmoothed aggregates correct too little, hence a second visit
// of the coarser levels (they are tiny).

namespace sphparam {
namespace {

constexpr double strong = 0.05;     // |A_ij| ≥ this · √(|A_ii||A_jj|)
constexpr int coarsest_rows = 100;  // solved directly
constexpr double least_shrinkage = 0.8;
constexpr int sweep_block = 512;           // rows
constexpr double coarsest_shift = 1e-8;    // of a block's trace
constexpr int least_parallel_rows = 2048;  // below it waking the other threads costs more

/// The lower triangle, shifted. Columns of the rows are in order, so that it is written in one go.
template <int modes>
Eigen::SparseMatrix<double> lower_triangle(const BlockMatrix<modes>& a) {
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

}  // namespace

Multigrid::Multigrid(const BlockMatrix<2>& matrix, const SweepOrder& order,
                     const ImagePoint* points, const float* units, const std::vector<char>& pinned,
                     int threads)
    : matrix_(matrix), order_(order), rows_{points, units}, threads_(threads) {
  coarsen(matrix_, pinned, aggregates_);
  fill_first();
  while (levels_.back().matrix.rows() > coarsest_rows) {
    Aggregates aggregates;
    if (!coarsen(levels_.back().matrix, {}, aggregates)) break;
    levels_[levels_.size() - 2].aggregates = std::move(aggregates);
    fill(levels_.size() - 1);
  }
  for (Level& level : levels_) {
    level.order = order_sweeps(level.matrix.start, level.matrix.column, sweep_block);
    for (Unknowns* x : {&level.b, &level.x, &level.r, &level.first_x}) {
      x->resize(at(modes) * at(level.matrix.rows()));
    }
  }
  const Eigen::SparseMatrix<double> coarsest = lower_triangle(levels_.back().matrix);
  coarsest_.analyzePattern(coarsest);
  coarsest_.factorize(coarsest);
}

/// Appends a level with the pattern of the matrix's aggregates. False: the matrix does not coarsen.
template <int N>
bool Multigrid::coarsen(const BlockMatrix<N>& matrix, const std::vector<char>& pinned,
                        Aggregates& aggregates) {
  for (const double strength : {strong, 0.0}) {
    aggregates = aggregate(matrix, pinned, strength);
    if (aggregates.count() <= least_shrinkage * matrix.rows()) break;
  }
  if (aggregates.count() > least_shrinkage * matrix.rows() && !levels_.empty()) return false;
  Level level;
  make_pattern(matrix, aggregates, level.matrix);
  levels_.push_back(std::move(level));
  return true;
}

void Multigrid::update(const ImagePoint* points) {
  rows_.points = points;
  fill_first();
  for (size_t l = 1; l < levels_.size(); ++l) fill(l);
  coarsest_.factorize(lower_triangle(levels_.back().matrix));
}

void Multigrid::fill_first() {
  Level& coarse = levels_.front();
  coarse.sites = gather_sites(rows_, aggregates_, threads_);
  restrict_matrix(matrix_, point_prolongation(rows_, aggregates_, coarse.sites, threads_),
                  aggregates_, coarse.matrix, threads_);
  invert(coarse.matrix.diagonal, coarse.inverse, threads_);
}

void Multigrid::fill(size_t l) {
  Level &fine = levels_[l - 1], &coarse = levels_[l];
  coarse.sites = gather_sites(fine.sites, fine.aggregates);
  fine.prolongation = site_prolongation(fine.sites, fine.aggregates, coarse.sites);
  restrict_matrix(fine.matrix, fine.prolongation, fine.aggregates, coarse.matrix, threads_);
  invert(coarse.matrix.diagonal, coarse.inverse, threads_);
}

/// levels_[l].x = approximately A⁻¹ levels_[l].b
void Multigrid::cycle(size_t l) {
  Level& level = levels_[l];
  const int threads = level.matrix.rows() < least_parallel_rows ? 1 : threads_;
  const auto vector = [](Unknowns& v) {
    return Eigen::Map<Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  if (l + 1 == levels_.size()) {
    // Where it has no factor, what comes down from finer levels stays as their sweeps left it.
    if (coarsest_.info() == Eigen::Success) {
      vector(level.x) = coarsest_.solve(vector(level.b));
    } else {
      vector(level.x).setZero();
    }
    return;
  }
  Level& coarse = levels_[l + 1];
  std::fill(level.x.begin(), level.x.end(), 0.0);
  sweep(level.matrix, level.inverse, level.order, level.b.data(), level.x.data(), Sweep::Forward,
        threads);
  residual(level.matrix, level.b.data(), level.x.data(), level.r.data(), threads);
  restrict_vector(level.prolongation, level.aggregates, level.r.data(), coarse.b.data(), threads);
  cycle(l + 1);
  if (l + 2 < levels_.size()) {
    coarse.first_x = coarse.x;
    residual(coarse.matrix, coarse.b.data(), coarse.x.data(), coarse.r.data(), threads);
    coarse.b.swap(coarse.r);
    cycle(l + 1);
    vector(coarse.x) += vector(coarse.first_x);
  }
  prolong_vector(level.prolongation, level.aggregates.of_row, coarse.x.data(), level.x.data(),
                 threads);
  sweep(level.matrix, level.inverse, level.order, level.b.data(), level.x.data(), Sweep::Backward,
        threads);
}

void Multigrid::apply(const Unknowns& b, Unknowns& x, Unknowns& rest) {
  std::fill(x.begin(), x.end(), 0.0);
  sweep(matrix_, SmallInverses{}, order_, b.data(), x.data(), Sweep::Forward, threads_);
  residual(matrix_, b.data(), x.data(), rest.data(), threads_);
  Level& first = levels_.front();
  restrict_from_points(rows_, aggregates_, first.sites, rest.data(), first.b.data(), threads_);
  cycle(0);
  prolong_to_points(rows_, aggregates_, first.sites, first.x.data(), x.data(), threads_);
  sweep(matrix_, SmallInverses{}, order_, b.data(), x.data(), Sweep::Backward, threads_);
}

}  // namespace sphparam
