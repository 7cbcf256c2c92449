#include "curvilinear/tangential_smoothing.h"

#include "mesh/rings.h"
#include "option_domain.h"
#include "sphparam/mesh/edge_weights.h"

// Gauss–Seidel on the sphere: each vertex moves to the weighted mean of its neighbours, seen in the
// tangent plane, and back to the sphere; vertices outside the patch stay.

namespace sphparam {
namespace {

/// 𝓛(x_i) = Σ_j w_ij x_j / Σ_j w_ij − x_i
Vector3 laplacian(const Topology& topology, const std::vector<double>& weights,
                  const SphereMap& map, Vertex i) {
  Vector3 sum = Vector3::Zero();
  double total = 0;
  topology.for_each_outgoing(i, [&](Halfedge h) {
    const double w = weights.empty() ? 1 : weights[static_cast<size_t>(h)];
    sum += w * map.point(topology.target(h));
    total += w;
  });
  return sum / total - map.point(i);
}

}  // namespace

std::vector<Vertex> date_line_patch(const Topology& topology, const DateLine& date_line,
                                    int rings) {
  return rings_in_order(topology, date_line.path, rings);
}

SphereMap smooth_date_line(const TriangleMesh& mesh, const Topology& topology,
                           const DateLine& date_line, SphereMap map,
                           const SmoothingOptions& options) {
  require_at_least("rings", options.rings, 0);
  require_at_least("sweeps", options.sweeps, 0);
  require_one_of("laplacian", options.laplacian, SmoothingOptions::Operator::Uniform);
  std::vector<double> weights;  // empty: uniform
  if (options.laplacian == SmoothingOptions::Operator::MeanValue) {
    const EdgeWeights mean_value(mesh, topology, WeightKind::MeanValue, options.threads);
    weights = mean_value.with(topology, {}, options.threads);
  }
  const std::vector<Vertex> patch = date_line_patch(topology, date_line, options.rings);
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    for (const Vertex i : patch) {
      const Vector3 x = map.point(i);
      const Vector3 step = laplacian(topology, weights, map, i);
      const Vector3 moved = x + (step - step.dot(x) * x);
      map.points.row(i) = moved.normalized();
    }
  }
  return map;
}

}  // namespace sphparam
