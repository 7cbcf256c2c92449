#include "sphparam/baselines/hemispheres.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "baselines/harmless_mesh.h"
#include "baselines/outcome.h"
#include "baselines/tutte_equations.h"
#include "baselines/weighted_rings.h"
#include "elementary.h"
#include "mesh/laplace_system.h"
#include "option_domain.h"
#include "sphparam/mesh/edge_weights.h"

// seam → unit circle by arc length; both halves by one system, as no edge joins their inner
// vertices; (u, v) → (2u, 2v, ±(1 − r²)) / (1 + r²); then the equations on the sphere.
#include "number_text.h"

namespace sphparam {
namespace {

constexpr double smallest_arc = 1e-3;  // of the mean arc: seam edges of length zero get that

/// Longitudes of the seam's vertices, in proportion to arc length.
std::vector<double> seam_longitudes(const TriangleMesh& mesh, const std::vector<Vertex>& seam) {
  std::vector<double> lengths;
  double sum = 0;
  for (size_t k = 0; k < seam.size(); ++k) {
    const Vertex next = seam[(k + 1) % seam.size()];
    lengths.push_back((mesh.position(next) - mesh.position(seam[k])).norm());
    sum += lengths.back();
  }
  const double least = sum > 0 ? smallest_arc * sum / double(seam.size()) : 1;
  sum = 0;
  for (double& length : lengths) sum += length = std::max(length, least);
  std::vector<double> longitudes = {0};
  for (const double length : lengths) {
    longitudes.push_back(longitudes.back() + 2 * std::numbers::pi * length / sum);
  }
  longitudes.pop_back();
  return longitudes;
}

/// 1 north, −1 south, 0 on the seam.
std::vector<int> hemisphere_of_vertices(const Topology& topology, const Bisection& bisection) {
  std::vector<int> hemisphere(static_cast<size_t>(topology.vertex_count()), 0);
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    const char side = bisection.side[static_cast<size_t>(Topology::face(h))];
    hemisphere[static_cast<size_t>(topology.origin(h))] = side == 0 ? 1 : -1;
  }
  for (const Vertex v : bisection.seam) hemisphere[static_cast<size_t>(v)] = 0;
  return hemisphere;
}

/// The residual is a difference of near-equal numbers: below the tolerance its digits say nothing.
std::string describe(const TutteSolution& solution, double tolerance) {
  const bool solved = solution.residual <= tolerance;
  return std::to_string(solution.sweeps) + " sweeps and " + std::to_string(solution.steps) +
         " Newton steps; the residual is " + (solved ? "at most " : "") +
         short_number(solved ? tolerance : solution.residual) + " of the hemispheres'";
}

}  // namespace

SphereMap place_hemispheres(const TriangleMesh& given, const Topology& topology,
                            const Bisection& bisection, int threads) {
  const HarmlessMesh harmless(given);
  const TriangleMesh& mesh = harmless.mesh;
  std::vector<VertexRole> roles(static_cast<size_t>(topology.vertex_count()), VertexRole::Free);
  MatrixX plane = MatrixX::Zero(topology.vertex_count(), 2);
  const std::vector<double> longitudes = seam_longitudes(mesh, bisection.seam);
  for (size_t k = 0; k < bisection.seam.size(); ++k) {
    const Vertex v = bisection.seam[k];
    roles[static_cast<size_t>(v)] = VertexRole::Fixed;
    plane.row(v) << elementary::cos(longitudes[k]), elementary::sin(longitudes[k]);
  }
  LaplaceSystem system(topology, std::move(roles), true, threads);
  system.factorise(EdgeWeights(mesh, topology, WeightKind::SymmetricMeanValue, threads)
                       .with(topology, {}, threads),
                   threads);
  plane = system.solve(plane, {}, threads);
  const std::vector<int> hemisphere = hemisphere_of_vertices(topology, bisection);
  SphereMap map{Points(topology.vertex_count(), 3)};
  for (Vertex v = 0; v < topology.vertex_count(); ++v) {
    const double r2 = plane.row(v).squaredNorm();
    const Vector3 x(2 * plane(v, 0), 2 * plane(v, 1),
                    hemisphere[static_cast<size_t>(v)] * (1 - r2));
    map.points.row(v) = x.normalized();
  }
  return map;
}

BaselineResult map_hemispheres(const TriangleMesh& given, const Topology& topology,
                               const HemispheresOptions& options, const Progress& progress) {
  require_one_of("weights", options.weights, WeightKind::SymmetricMeanValue);
  if (options.weights == WeightKind::MeanValue) {
    refuse_option("weights", static_cast<int>(options.weights), "a symmetric kind");
  }
  require_at_least("max_sweeps", options.max_sweeps, 0);
  require_at_least("max_steps", options.max_steps, 0);
  require_at_least("tolerance", options.tolerance, 0);
  const HarmlessMesh harmless(given);
  const TriangleMesh& mesh = harmless.mesh;
  return run_rival([&](Outcome& outcome) {
    report(progress, "bisection", 0);
    const Bisection bisection = bisect(mesh, topology, options.threads);
    outcome.finish_stage("bisection");
    report(progress, "hemispheres", 0);
    SphereMap map = place_hemispheres(mesh, topology, bisection, options.threads);
    outcome.finish_stage("hemispheres");
    const std::vector<double> weights =
        EdgeWeights(mesh, topology, options.weights, options.threads)
            .with(topology, {}, options.threads);
    TutteEquations equations(topology, weights);
    TutteSolution solution = equations.sweep(std::move(map), options.max_sweeps, progress);
    outcome.finish_stage("Gauss–Seidel", solution.sweeps);
    solution =
        equations.newton(std::move(solution), options.max_steps, options.tolerance, progress);
    outcome.finish_stage("Newton", solution.steps);
    const std::string numbers = describe(solution, options.tolerance);
    if (solution.residual <= options.tolerance) {
      return outcome.take(std::move(solution.map), BaselineEnd::Converged, "solved by " + numbers);
    }
    const bool stalled = solution.steps < options.max_steps;
    return outcome.take(
        std::move(solution.map), stalled ? BaselineEnd::Stalled : BaselineEnd::IterationLimit,
        (stalled ? "no step lowers the residual further after " : "not solved by ") + numbers);
  });
}

}  // namespace sphparam
