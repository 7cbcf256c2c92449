#include "sphparam/baselines/conformal.h"

#include <utility>
#include <vector>

#include "baselines/harmless_mesh.h"
#include "baselines/mobius_centring.h"
#include "baselines/outcome.h"
#include "baselines/weighted_rings.h"
#include "number_text.h"
#include "option_domain.h"
#include "sphparam/mesh/edge_weights.h"
#include "sphparam/parallel.h"

// x_i ← x_i + δ (I − x_i x_iᵀ) Σ_j w_ij (x_j − x_i) / Σ_j |w_ij|, back to the sphere, all vertices
// from the same old map; then the Möbius transformation. A step that raises the energy is taken
// back and δ halved, else δ grows a little.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;
constexpr double longest_step = 1, shortest_step = 1e-6;  // δ; 1 is the plain mean of neighbours
constexpr double growth = 1.1;                            // of δ after a step that was good

/// The Gauss map: unit normals, weighted by area; where there is none, any other direction.
SphereMap gauss_map(const TriangleMesh& mesh) {
  Points normals = Points::Zero(mesh.vertex_count(), 3);
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto t = mesh.triangles.row(f);
    const Vector3 p = mesh.position(t[0]);
    const Vector3 normal = (mesh.position(t[1]) - p).cross(mesh.position(t[2]) - p);
    for (int k = 0; k < 3; ++k) normals.row(t[k]) += normal;
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0) {
      normals.row(v) /= length;
    } else {
      normals.row(v) << 0, 0, 1;
    }
  }
  return {std::move(normals)};
}

/// A map with Σ_j w_ij (x_j − x_i) of every vertex and its energy ½ Σ_edges w_ij |x_i − x_j|²,
/// which is −½ Σ_i x_i · pull_i for unit points.
struct State {
  SphereMap map;
  Points pulls;
  double energy;
};

struct Descent {
  const WeightedRings& rings;
  const VectorX& mass;
  const ConformalOptions& options;

  State measured(SphereMap map) const {
    State state{std::move(map), Points(rings.vertex_count(), 3), 0};
    const auto of_chunk = [&](std::int64_t first, std::int64_t last) {
      double sum = 0;
      for (Vertex i = static_cast<Vertex>(first); i < last; ++i) {
        const Vector3 pull = rings.pull(state.map.points, i);
        state.pulls.row(i) = pull;
        sum -= state.map.point(i).dot(pull) / 2;
      }
      return sum;
    };
    state.energy = parallel_sum(rings.vertex_count(), options.threads, of_chunk);
    return state;
  }

  State step(const State& state, const std::vector<double>& totals, double delta) const {
    SphereMap next{Points(rings.vertex_count(), 3)};
    parallel_for(rings.vertex_count(), grain, options.threads,
                 [&](std::int64_t first, std::int64_t last) {
                   for (Vertex i = static_cast<Vertex>(first); i < last; ++i) {
                     const Vector3 x = state.map.point(i), pull = state.pulls.row(i);
                     const double total = totals[static_cast<size_t>(i)];
                     const double scale = total > 0 ? delta / total : 0;
                     next.points.row(i) = (x + scale * (pull - pull.dot(x) * x)).normalized();
                   }
                 });
    return measured(mobius_centred(std::move(next), mass, 1, options.threads));
  }
};

struct DescentEnd {
  int iterations = 0;
  bool converged = false;
  double energy = 0;
};

DescentEnd descend(const Descent& descent, SphereMap& map, const char* stage,
                   const Progress& progress) {
  std::vector<double> totals;
  for (Vertex i = 0; i < descent.rings.vertex_count(); ++i) {
    totals.push_back(descent.rings.total(i));
  }
  const ConformalOptions& options = descent.options;
  DescentEnd end;
  State state = descent.measured(std::move(map));
  double delta = longest_step / 2;
  while (end.iterations < options.max_iterations && !end.converged) {
    report(progress, stage, double(end.iterations) / options.max_iterations);
    ++end.iterations;
    State next = descent.step(state, totals, delta);
    if (!(next.energy < state.energy)) {
      delta /= 2;
      end.converged = delta < shortest_step;
      continue;
    }
    end.converged = state.energy - next.energy < options.least_gain * state.energy;
    state = std::move(next);
    delta = std::min(longest_step, growth * delta);
  }
  map = std::move(state.map);
  end.energy = state.energy;
  return end;
}

}  // namespace

BaselineResult map_conformal(const TriangleMesh& given, const Topology& topology,
                             const ConformalOptions& options, const Progress& progress) {
  require_at_least("max_iterations", options.max_iterations, 0);
  require_between("least_gain", options.least_gain, 0, 1);
  const HarmlessMesh harmless(given);
  const TriangleMesh& mesh = harmless.mesh;
  Outcome outcome;
  const VectorX mass = vertex_masses(mesh);
  SphereMap map = mobius_centred(gauss_map(mesh), mass, 60, options.threads);
  outcome.finish_stage("Gauss map");

  const WeightedRings tutte(topology, {});
  const DescentEnd first = descend({tutte, mass, options}, map, "Tutte energy", progress);
  outcome.finish_stage("Tutte energy", first.iterations);

  const EdgeWeights cotangent(mesh, topology, WeightKind::Cotangent, options.threads);
  const WeightedRings harmonic(topology, cotangent.with(topology, {}, options.threads));
  const DescentEnd last = descend({harmonic, mass, options}, map, "harmonic energy", progress);
  map = mobius_centred(std::move(map), mass, 60, options.threads);
  outcome.finish_stage("harmonic energy", last.iterations);

  const bool converged = first.converged && last.converged;
  const std::string energy =
      "; harmonic energy " + short_number(last.energy, 8) + " (that of a conformal map: 12.566371)";
  return outcome.take(std::move(map),
                      converged ? BaselineEnd::Converged : BaselineEnd::IterationLimit,
                      (converged ? "both descents ended by their rule"
                                 : "not converged after " + std::to_string(options.max_iterations) +
                                       " iterations of a descent") +
                          energy);
}

}  // namespace sphparam
