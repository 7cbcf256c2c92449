#pragma once

#include <memory>
#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// A symmetric sparse system with one block (1×1 or 2×2) a vertex and one an edge.
///
/// Unknowns are numbered once in the order of elimination and their pattern is analysed once, as in
/// `LaplaceSystem`, which has no mass terms, right sides or blocks.
class VertexSystem {
 public:
  /// Requires: the topology outlives the system.
  VertexSystem(const Topology& topology, int block);
  ~VertexSystem();

  /// diagonal: block² numbers a vertex; off_diagonal: block² numbers a half-edge i → j, A_ij. All
  /// row by row. Requires: the blocks of twins are transposes of each other.
  /// Throws: SolveError on a zero or infinite pivot.
  void factorise(const std::vector<double>& diagonal, const std::vector<double>& off_diagonal);

  /// b, result: one column a right side, `block` rows a vertex. Throws: SolveError if not finite.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Factor;
  void number_vertices();

  const Topology& topology_;
  int block_;
  std::vector<int> place_;  // per vertex: its place in the order of elimination
  std::vector<Vertex> vertex_at_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace sphparam
