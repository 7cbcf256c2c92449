#pragma once

#include <span>
#include <vector>

#include "sphparam/remesh/limit_surface.h"

namespace sphparam {

/// Points of a limit surface as linear combinations of its control points, at the same places of
/// every patch: what a fit needs.
///
/// Patches that are one polynomial share their weights; those next to a vertex of unusual valence
/// have their own, and depend on all that is about it.
class LimitStencils {
 public:
  /// Row i: how much of each of the patch's control points is in its point i. Rows sum to 1.
  using Weights = Eigen::MatrixXd;

  /// `places`: (s, t) of m points of a patch, the same for all; see LimitPlace.
  /// Ensures: the same bytes for any number of threads. Cost: about 0.5 µs a patch; next to a
  /// vertex of valence k, m·k weights a patch.
  LimitStencils(const LimitTopology& topology, std::vector<Eigen::Vector2d> places,
                int threads = 0);

  int vertex_count() const { return vertex_count_; }
  int patch_count() const { return static_cast<int>(starts_.size()) - 1; }
  const std::vector<Eigen::Vector2d>& places() const { return places_; }

  /// Which control points patch p depends on: entries first_entry(p) … first_entry(p + 1) − 1 of
  /// all patches' lists, put one after another.
  std::span<const int> controls(int patch) const {
    return {controls_.data() + first_entry(patch),
            static_cast<size_t>(first_entry(patch + 1) - first_entry(patch))};
  }
  std::int64_t first_entry(int patch) const { return starts_[static_cast<size_t>(patch)]; }
  /// m × #controls(patch).
  const Weights& weights(int patch) const {
    return tables_[static_cast<size_t>(table_of_[static_cast<size_t>(patch)])];
  }

 private:
  void lay_out(const std::vector<int>& sizes);

  int vertex_count_;
  std::vector<Eigen::Vector2d> places_;
  std::vector<std::int64_t> starts_;  // #patches + 1
  std::vector<int> controls_;
  std::vector<int> table_of_;    // a patch
  std::vector<Weights> tables_;  // the first for all polynomials
  int first_polynomial_ = -1;
};

/// The middles of n² equal pieces of a patch: small triangles by Loop's scheme, squares by
/// Catmull's and Clark's. Requires: n ≥ 1.
std::vector<Eigen::Vector2d> middles_of_pieces(Scheme scheme, int n);

}  // namespace sphparam
