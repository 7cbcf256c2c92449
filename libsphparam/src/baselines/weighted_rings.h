#pragma once

#include <vector>

#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Neighbours and weights of every vertex in one array, for thousands of sweeps.
class WeightedRings {
 public:
  /// weights: w[h] per half-edge, or empty for ones.
  WeightedRings(const Topology& topology, const std::vector<double>& weights) {
    start_.reserve(static_cast<size_t>(topology.vertex_count()) + 1);
    neighbours_.reserve(static_cast<size_t>(topology.halfedge_count()));
    start_.push_back(0);
    for (Vertex v = 0; v < topology.vertex_count(); ++v) {
      topology.for_each_outgoing(v, [&](Halfedge h) {
        neighbours_.push_back(
            {topology.target(h), weights.empty() ? 1 : weights[static_cast<size_t>(h)]});
      });
      start_.push_back(neighbours_.size());
    }
  }

  int vertex_count() const { return static_cast<int>(start_.size()) - 1; }

  /// Calls visit(j, w_ij) for every neighbour j.
  template <class Visit>
  void for_each(Vertex i, Visit&& visit) const {
    const size_t v = static_cast<size_t>(i);
    for (size_t k = start_[v]; k < start_[v + 1]; ++k) {
      visit(neighbours_[k].vertex, neighbours_[k].weight);
    }
  }

  /// Σ_j w_ij (x_j − x_i)
  Vector3 pull(const Points& points, Vertex i) const {
    const Vector3 x = points.row(i);
    Vector3 sum = Vector3::Zero();
    for_each(i, [&](Vertex j, double w) { sum += w * (points.row(j).transpose() - x); });
    return sum;
  }

  /// Σ_j |w_ij|
  double total(Vertex i) const {
    double sum = 0;
    for_each(i, [&](Vertex, double w) { sum += w < 0 ? -w : w; });
    return sum;
  }

 private:
  struct Neighbour {
    Vertex vertex;
    double weight;
  };
  std::vector<size_t> start_;
  std::vector<Neighbour> neighbours_;
};

}  // namespace sphparam
