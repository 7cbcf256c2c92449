#include "curvilinear/curvilinear_map.h"

#include <algorithm>
#include <utility>

#include "curvilinear/lift.h"
#include "curvilinear/quasi_harmonic.h"
#include "elementary.h"
#include "mesh/triangle_geometry.h"
#include "option_domain.h"

// (M, date line) → cylinder → (θ, ϕ) → κ_acc ← κ → (θ, ϕ) → κ_acc ← κ_acc·√κ → (θ, ϕ) → … while it
// gets better. The first step goes all the way, as the paper's does: far from the solution that is
// not yet too far.

namespace sphparam {
namespace {

constexpr double first_power = 1, power = 0.5;  // of κ in κ_acc

/// ε of the cap whose share of the sphere, (1 − cos ε)/2, is the star's share of the surface.
double cap_angle(const TriangleMesh& mesh, const Topology& topology, Vertex pole,
                 double total_area) {
  constexpr double least = 1e-4, greatest = 0.5;
  double star_area = 0;
  topology.for_each_outgoing(pole, [&](Halfedge h) {
    const Vector3 p = mesh.position(pole);
    const Vector3 a = mesh.position(topology.target(h)), b = mesh.position(topology.apex(h));
    star_area += triangle_area(p, a, b);
  });
  const double share = total_area > 0 ? std::min(star_area / total_area, 0.5) : 0;
  return std::clamp(elementary::acos(1 - 2 * share), least, greatest);
}

ChartBoundary boundary_for(const TriangleMesh& mesh, const Topology& topology,
                           const CutMesh& cut_mesh, double epsilon) {
  if (epsilon > 0) return cylinder_boundary(mesh, cut_mesh, epsilon, epsilon);
  const auto [north, south] = cut_mesh.poles();
  const double area = surface_area(mesh);
  return cylinder_boundary(mesh, cut_mesh, cap_angle(mesh, topology, north, area),
                           cap_angle(mesh, topology, south, area));
}

void require_domain(const CurvilinearOptions& options) {
  require_at_least("iterations", options.iterations, 0);
  require_between("epsilon", options.epsilon, 0, greatest_epsilon);
}

}  // namespace

CurvilinearResult map_curvilinear(const TriangleMesh& mesh, const Topology& topology,
                                  DateLine date_line, const CurvilinearOptions& options,
                                  const Progress& progress) {
  require_domain(options);
  const int threads = options.threads;
  report(progress, "harmonic map", 0);
  CurvilinearResult best;
  best.date_line = std::move(date_line);
  const CutMesh cut_mesh(topology, best.date_line);
  const EdgeWeights weights(mesh, topology, WeightKind::SymmetricMeanValue, threads);
  best.clamped_weights = weights.clamped();
  HarmonicSolver solver(topology, cut_mesh, boundary_for(mesh, topology, cut_mesh, options.epsilon),
                        true, threads);

  std::vector<double> accumulated;  // κ_acc
  for (int iteration = 0; iteration <= options.iterations; ++iteration) {
    report(progress, "quasi-harmonic map", double(iteration) / (options.iterations + 1));
    const CurvilinearMap chart =
        solver.solve(weights.with(topology, accumulated, threads), threads);
    const long folds = planar_folds(topology, cut_mesh, chart, threads);
    SphereMap sphere = lift(cut_mesh, chart, threads);
    const std::vector<double> kappa = area_distortion(mesh, sphere, threads);
    const double distortion = mean_abs_ln(kappa, threads);
    const bool better = iteration == 0 || folds < best.planar_folds ||
                        (folds == best.planar_folds && distortion < best.area_distortion.back());
    if (!better) break;
    best.map = std::move(sphere);
    best.planar_folds = folds;
    best.iterations = iteration;
    best.area_distortion.push_back(distortion);
    if (iteration == options.iterations) break;
    accumulate_kappa(accumulated, kappa, iteration == 0 ? first_power : power, threads);
  }
  return best;
}

CurvilinearResult map_curvilinear(const TriangleMesh& mesh, const Topology& topology, Poles poles,
                                  const CurvilinearOptions& options, const Progress& progress) {
  require_domain(options);
  require_vertex("poles.north", poles.north, mesh.vertex_count());
  require_vertex("poles.south", poles.south, mesh.vertex_count());
  report(progress, "date line", 0);
  return map_curvilinear(mesh, topology,
                         induced_date_line(topology, shortest_date_line(mesh, topology, poles)),
                         options, progress);
}

}  // namespace sphparam
