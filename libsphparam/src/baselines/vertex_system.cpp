#include "baselines/vertex_system.h"

#include <Eigen/SparseCholesky>
#include <string>

#include "sphparam/errors.h"

// The upper half is written column by column in the order of elimination, as in LaplaceSystem: the
// blocks above the diagonal in the order of the 1-ring, then the upper half of the diagonal block.
// Writing new values is the same walk as writing the pattern.

namespace sphparam {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
using Cholesky = Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>>;

/// Visits the entries of the upper half, column by column: visit(row, vertex, half-edge, r, c) for
/// entry (r, c) of a block; the half-edge is −1 in a diagonal block, else it runs to the vertex.
template <class Visit, class EndColumn>
void walk(const Topology& topology, int block, const std::vector<int>& place,
          const std::vector<Vertex>& vertex_at, Visit&& visit, EndColumn&& end_column) {
  for (const Vertex v : vertex_at) {
    const int column = place[static_cast<size_t>(v)];
    for (int c = 0; c < block; ++c) {
      topology.for_each_outgoing(v, [&](Halfedge h) {
        const int row = place[static_cast<size_t>(topology.target(h))];
        if (row >= column) return;
        for (int r = 0; r < block; ++r) visit(block * row + r, v, topology.twin(h), r, c);
      });
      for (int r = 0; r <= c; ++r) visit(block * column + r, v, -1, r, c);
      end_column();
    }
  }
}

}  // namespace

struct VertexSystem::Factor {
  Matrix matrix;
  Cholesky cholesky;
};

VertexSystem::VertexSystem(const Topology& topology, int block)
    : topology_(topology), block_(block), factor_(std::make_unique<Factor>()) {
  number_vertices();
  std::vector<int> rows, starts = {0};
  walk(
      topology_, block_, place_, vertex_at_,
      [&](int row, Vertex, Halfedge, int, int) { rows.push_back(row); },
      [&] { starts.push_back(static_cast<int>(rows.size())); });
  Matrix& matrix = factor_->matrix;
  matrix.resize(block_ * topology.vertex_count(), block_ * topology.vertex_count());
  matrix.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
  std::copy(starts.begin(), starts.end(), matrix.outerIndexPtr());
  std::copy(rows.begin(), rows.end(), matrix.innerIndexPtr());
  factor_->cholesky.analyzePattern(matrix);
}

VertexSystem::~VertexSystem() = default;

/// Minimum degree on the graph of the vertices: blocks stay together.
void VertexSystem::number_vertices() {
  const int n = topology_.vertex_count();
  Matrix graph(n, n);
  std::vector<Eigen::Triplet<double, int>> entries;
  for (Vertex v = 0; v < n; ++v) entries.emplace_back(v, v, 1.0);
  for (Halfedge h = 0; h < topology_.halfedge_count(); ++h) {
    const Vertex i = topology_.origin(h), j = topology_.target(h);
    if (i < j) entries.emplace_back(i, j, 1.0);
  }
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Upper>(), order);
  vertex_at_.resize(static_cast<size_t>(n));
  place_.resize(static_cast<size_t>(n));
  for (int i = 0; i < n; ++i) {
    vertex_at_[static_cast<size_t>(i)] = order.indices()[i];
    place_[static_cast<size_t>(order.indices()[i])] = i;
  }
}

void VertexSystem::factorise(const std::vector<double>& diagonal,
                             const std::vector<double>& off_diagonal) {
  const size_t block = static_cast<size_t>(block_), size = block * block;
  double* entry = factor_->matrix.valuePtr();
  walk(
      topology_, block_, place_, vertex_at_,
      [&](int, Vertex v, Halfedge to_v, int r, int c) {
        const size_t inside = block * static_cast<size_t>(r) + static_cast<size_t>(c);
        *entry++ = to_v < 0 ? diagonal[size * static_cast<size_t>(v) + inside]
                            : off_diagonal[size * static_cast<size_t>(to_v) + inside];
      },
      [] {});
  factor_->cholesky.factorize(factor_->matrix);
  if (factor_->cholesky.info() != Eigen::Success) {
    throw SolveError("system of " + std::to_string(factor_->matrix.rows()) +
                     " unknowns: the factorisation failed (a zero or infinite pivot)");
  }
}

Eigen::MatrixXd VertexSystem::solve(const Eigen::MatrixXd& b) const {
  const auto at = [&](int i) { return block_ * vertex_at_[static_cast<size_t>(i)]; };
  Eigen::MatrixXd permuted(b.rows(), b.cols());
  for (int i = 0; i < topology_.vertex_count(); ++i) {
    permuted.middleRows(block_ * i, block_) = b.middleRows(at(i), block_);
  }
  const Eigen::MatrixXd x = factor_->cholesky.solve(permuted);
  if (!x.allFinite()) {
    throw SolveError("system of " + std::to_string(b.rows()) +
                     " unknowns: the solution is not finite");
  }
  Eigen::MatrixXd result(b.rows(), b.cols());
  for (int i = 0; i < topology_.vertex_count(); ++i) {
    result.middleRows(at(i), block_) = x.middleRows(block_ * i, block_);
  }
  return result;
}

}  // namespace sphparam
