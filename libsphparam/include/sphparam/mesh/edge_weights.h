#pragma once

#include <vector>

#include "sphparam/mesh/topology.h"

namespace sphparam {

enum class WeightKind {
  Cotangent,           // paper: Section 4, the equation with κ_j cot α_j + κ_{j+1} cot β_{j+1}
  MeanValue,           // paper: Section 4, the equation with κ_j tan γ_j/2; not symmetric
  SymmetricMeanValue,  // our own: (w_ij + w_ji)/2; without symmetry no periodic θ exists
};

/// The weights w_ij of the discrete (quasi-)harmonic equation Σ_j w_ij (U_j − U_i) = 0.
///
/// The geometry (cotangents, tan γ/2, edge lengths) is measured once; `with` then costs one pass
/// for any field κ. Degenerate triangles are tamed: mean value corner terms are clamped to
/// [1e-6, 1e6] times their median (robust to zero-area faces and coincident vertices; `clamped`
/// counts the corner terms that were). Cotangents are left as they are, negative ones included, but
/// for flooring the area of a triangle at 1e-12 times its longest edge squared: that is what the
/// paper prints.
class EdgeWeights {
 public:
  /// Requires: finite positions, their squares as well. Cost: one pass, 24 bytes a triangle (48 for
  /// MeanValue). Same bits for any number of threads.
  EdgeWeights(const TriangleMesh& mesh, const Topology& topology, WeightKind kind, int threads = 0);

  /// w[h] = w_ij for each half-edge h = (i → j), given κ per face (empty: κ ≡ 1).
  /// Shapes: kappa #F or empty; result 3·#F. Ensures: mean value weights are positive where κ is.
  std::vector<double> with(const Topology& topology, const std::vector<double>& kappa = {},
                           int threads = 0) const;

  WeightKind kind() const { return kind_; }
  bool symmetric() const { return kind_ != WeightKind::MeanValue; }
  long clamped() const { return clamped_; }

 private:
  void clamp_terms(std::vector<double>& terms, double median);

  WeightKind kind_;
  long clamped_ = 0;
  std::vector<double> forward_;   // what h's own face adds to w(origin → target)
  std::vector<double> backward_;  // … to w(target → origin); empty when that is the same
};

}  // namespace sphparam
