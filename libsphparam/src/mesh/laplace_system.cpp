#include "mesh/laplace_system.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <optional>

#include "sphparam/errors.h"
#include "sphparam/parallel.h"

// The matrix A of free vertices has A_ii = Σ_j w_ij and A_ij = −w_ij; fixed neighbours and jumps go
// to the right-hand side. Columns are written straight from the 1-rings, in the order of
// elimination: Eigen's solvers then neither reorder nor copy the matrix. Rows within a column stand
// in the order of the 1-ring, so that writing new values is the same walk as writing the pattern;
// neither solver asks for sorted rows. Of a symmetric matrix the upper half is kept.

namespace sphparam {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
using Cholesky = Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>>;
using LU = Eigen::SparseLU<Matrix, Eigen::NaturalOrdering<int>>;

constexpr std::int64_t grain = 2048;  // columns a chunk

/// Does the matrix keep the entry of this row (-1: not an unknown) off the diagonal?
bool is_kept(int row, int column, bool upper_half) {
  return row >= 0 && (!upper_half || row < column);
}

}  // namespace

struct LaplaceSystem::Factor {
  bool symmetric;
  Matrix matrix;
  std::optional<Cholesky> cholesky;
  std::optional<LU> lu;
};

LaplaceSystem::LaplaceSystem(const Topology& topology, std::vector<VertexRole> roles,
                             bool symmetric, int threads)
    : topology_(&topology),
      roles_(std::move(roles)),
      unknown_(static_cast<size_t>(topology.vertex_count()), -1),
      factor_(std::make_unique<Factor>()) {
  factor_->symmetric = symmetric;
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    if (roles_[static_cast<size_t>(v)] != VertexRole::Free) continue;
    unknown_[static_cast<size_t>(v)] = unknown_count();
    vertex_of_.push_back(v);
  }
  number_unknowns(threads);
  build_pattern(symmetric, threads);
  if (unknown_count() == 0) return;
  if (symmetric) {
    factor_->cholesky.emplace();
    factor_->cholesky->analyzePattern(factor_->matrix);
  } else {
    factor_->lu.emplace();
    // The pattern is symmetric and the diagonal dominates: nothing is gained by pivoting off it.
    factor_->lu->isSymmetric(true);
    factor_->lu->setPivotThreshold(0);
    factor_->lu->analyzePattern(factor_->matrix);
  }
}

LaplaceSystem::~LaplaceSystem() = default;
LaplaceSystem::LaplaceSystem(LaplaceSystem&&) noexcept = default;
LaplaceSystem& LaplaceSystem::operator=(LaplaceSystem&&) noexcept = default;

/// Renumbers the unknowns in the order of elimination that keeps the factor sparse.
void LaplaceSystem::number_unknowns(int threads) {
  build_pattern(true, threads);
  factor_->matrix.coeffs().setZero();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(factor_->matrix.selfadjointView<Eigen::Upper>(), order);
  std::vector<Vertex> reordered(vertex_of_.size());
  for (size_t i = 0; i < reordered.size(); ++i) {
    reordered[i] = vertex_of_[static_cast<size_t>(order.indices()[static_cast<int>(i)])];
    unknown_[static_cast<size_t>(reordered[i])] = static_cast<int>(i);
  }
  vertex_of_ = std::move(reordered);
}

void LaplaceSystem::build_pattern(bool upper_half, int threads) {
  const int n = unknown_count();
  Matrix& matrix = factor_->matrix;
  matrix.resize(n, n);
  const auto for_each_row = [&](int column, auto&& visit) {
    topology_->for_each_outgoing(vertex_of_[static_cast<size_t>(column)], [&](Halfedge h) {
      const int row = unknown_[static_cast<size_t>(topology_->target(h))];
      if (is_kept(row, column, upper_half)) visit(row);
    });
    visit(column);
  };
  // 1. How many entries a column has, summed to where it starts.
  int* start = matrix.outerIndexPtr();
  start[0] = 0;
  parallel_for(n, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (int column = static_cast<int>(first); column < last; ++column) {
      start[column + 1] = 0;
      for_each_row(column, [&](int) { ++start[column + 1]; });
    }
  });
  for (int column = 0; column < n; ++column) start[column + 1] += start[column];
  // 2. The rows of its entries.
  matrix.resizeNonZeros(start[n]);
  parallel_for(n, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (int column = static_cast<int>(first); column < last; ++column) {
      int* row_of_entry = matrix.innerIndexPtr() + start[column];
      for_each_row(column, [&](int row) { *row_of_entry++ = row; });
    }
  });
}

void LaplaceSystem::factorise(std::vector<double> weights, int threads) {
  weights_ = std::move(weights);
  if (unknown_count() == 0) return;
  // 1. The entries, in the order of the pattern.
  Matrix& matrix = factor_->matrix;
  parallel_for(unknown_count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (int column = static_cast<int>(first); column < last; ++column) {
      double* entry = matrix.valuePtr() + matrix.outerIndexPtr()[column];
      double diagonal = 0;
      topology_->for_each_outgoing(vertex_of_[static_cast<size_t>(column)], [&](Halfedge h) {
        const size_t neighbour = static_cast<size_t>(topology_->target(h));
        if (roles_[neighbour] == VertexRole::Removed) return;
        // A_ii = Σ_j w_ij,  A_ij = −w_ij; down column i stand the A_ji = −w_ji.
        diagonal += weights_[static_cast<size_t>(h)];
        if (is_kept(unknown_[neighbour], column, factor_->symmetric)) {
          *entry++ = -weights_[static_cast<size_t>(topology_->twin(h))];
        }
      });
      *entry = diagonal;
    }
  });
  // 2. The factors.
  const auto factorise_by = [&](auto& solver) {
    solver.factorize(matrix);
    if (solver.info() != Eigen::Success) {
      throw SolveError("Laplace system of " + std::to_string(unknown_count()) +
                       " unknowns: the factorisation failed (a zero or infinite pivot)");
    }
  };
  factor_->symmetric ? factorise_by(*factor_->cholesky) : factorise_by(*factor_->lu);
}

VectorX LaplaceSystem::right_hand_side(const Eigen::Ref<const VectorX>& values,
                                       const std::vector<Jump>& jumps) const {
  // b_i = Σ_{j fixed} w_ij U_j + Σ_j w_ij jump_ij
  VectorX b = VectorX::Zero(unknown_count());
  for (Vertex v = 0; v < topology_->vertex_count(); ++v) {
    if (roles_[static_cast<size_t>(v)] != VertexRole::Fixed) continue;
    topology_->for_each_outgoing(v, [&](Halfedge h) {
      const int i = unknown_[static_cast<size_t>(topology_->target(h))];
      if (i >= 0) b[i] += weights_[static_cast<size_t>(topology_->twin(h))] * values[v];
    });
  }
  for (const Jump& jump : jumps) {
    const int i = unknown_[static_cast<size_t>(topology_->origin(jump.halfedge))];
    const Vertex j = topology_->target(jump.halfedge);
    if (i < 0 || roles_[static_cast<size_t>(j)] == VertexRole::Removed) continue;
    b[i] += weights_[static_cast<size_t>(jump.halfedge)] * jump.value;
  }
  return b;
}

MatrixX LaplaceSystem::solve(const MatrixX& values, const std::vector<std::vector<Jump>>& jumps,
                             int threads) const {
  MatrixX result = values;
  if (unknown_count() == 0) return result;
  parallel_for(values.cols(), 1, threads, [&](std::int64_t first, std::int64_t last) {
    for (Eigen::Index k = first; k < last; ++k) {
      const std::vector<Jump> none;
      const VectorX b =
          right_hand_side(values.col(k), jumps.empty() ? none : jumps[static_cast<size_t>(k)]);
      VectorX x = factor_->symmetric ? VectorX(factor_->cholesky->solve(b))
                                     : VectorX(factor_->lu->solve(b));
      if (!x.allFinite()) {
        throw SolveError("Laplace system of " + std::to_string(unknown_count()) +
                         " unknowns: the solution is not finite");
      }
      for (int i = 0; i < unknown_count(); ++i) {
        result(vertex_of_[static_cast<size_t>(i)], k) = x[i];
      }
    }
  });
  return result;
}

}  // namespace sphparam
