#pragma once

#include <memory>
#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

/// What a vertex is in the linear system.
enum class VertexRole : char {
  Free,     // an unknown
  Fixed,    // its value is given (Dirichlet)
  Removed,  // not there, and no edge to it is: a pole
};

/// U grows by `value` along the half-edge, over and above the difference of its ends' values.
struct Jump {
  Halfedge halfedge;
  double value;
};

/// Σ_j w_ij (U_j + jump_ij − U_i) = 0 for every free vertex i, several right-hand sides at once.
///
/// The jump lets θ grow by 2π across the date line without cutting the mesh: jump_ij is what must
/// be added to U_j to compare it with U_i; it is listed for the few half-edges that have one, twins
/// separately and with opposite signs.
/// Unknowns are numbered once in the order of elimination (approximate minimum degree), and their
/// pattern is analysed once; `factorise` again with other weights reuses both. One factor is alive
/// at a time. Symmetric weights use Eigen's SimplicialLDLT, others its SparseLU.
/// Paper: Section 4, the discrete equation for all internal vertices.
class LaplaceSystem {
 public:
  /// roles: #V. Requires: at least one fixed vertex in every connected part of free ones; the
  /// topology outlives the system.
  LaplaceSystem(const Topology& topology, std::vector<VertexRole> roles, bool symmetric,
                int threads = 0);
  LaplaceSystem(const Topology&&, std::vector<VertexRole>, bool, int = 0) = delete;
  ~LaplaceSystem();
  LaplaceSystem(LaplaceSystem&&) noexcept;
  LaplaceSystem& operator=(LaplaceSystem&&) noexcept;

  /// weights: w[h] per half-edge (see EdgeWeights::with); kept for the right-hand sides.
  /// Requires: w of twins agree if the system is symmetric.
  /// Throws: SolveError naming the system when the factorisation fails.
  void factorise(std::vector<double> weights, int threads = 0);

  /// values: #V×k, read at fixed vertices only. jumps: k lists, or none at all.
  /// Returns #V×k: the solution at free vertices, `values` elsewhere.
  /// Requires: factorise was called. Throws: SolveError if the result is not finite.
  /// Same bits for any number of threads (one right-hand side each).
  MatrixX solve(const MatrixX& values, const std::vector<std::vector<Jump>>& jumps = {},
                int threads = 0) const;

  /// Gives the memory of the weights back: the next ones are usually made before `factorise` gets
  /// them. `solve` then needs `factorise` again.
  void forget_weights() { weights_ = {}; }

  int unknown_count() const { return static_cast<int>(vertex_of_.size()); }
  const std::vector<double>& weights() const { return weights_; }

 private:
  struct Factor;
  void number_unknowns(int threads);
  void build_pattern(bool upper_half, int threads);
  VectorX right_hand_side(const Eigen::Ref<const VectorX>& values,
                          const std::vector<Jump>& jumps) const;

  const Topology* topology_;
  std::vector<VertexRole> roles_;
  std::vector<int> unknown_;       // per vertex: its column, or -1
  std::vector<Vertex> vertex_of_;  // per column
  std::vector<double> weights_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace sphparam
