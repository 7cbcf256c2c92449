#include "curvilinear/harmonic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/triangle_geometry.h"
#include "option_domain.h"
#include "sphere/planar_orientation.h"
#include "sphparam/errors.h"
#include "sphparam/parallel.h"

// θ and ϕ have the same fixed vertices (the links; in the rectangle the date line too), so one
// matrix serves both. Twist: E(c) = ½ Σ w (Δθ₀ + cΔη)² is least at c = −Σ w Δθ₀Δη / Σ w (Δη)², and
// as θ₀ and η satisfy the equation and η is 0 on the north link and 1 on the south link, both sums
// are fluxes through the south link (summation by parts): Σ w ΔuΔη = Σ_{i ∈ link} Σ_j w_ij (u_i −
// u_j).

namespace sphparam {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double widest_gap = 0.9 * pi;
constexpr double narrowest_gap = 1e-3;  // of the mean gap

/// 0 and the partial sums of `steps`, scaled so that the whole is `total`; even if all are zero.
std::vector<double> cumulated(std::vector<double> steps, double total) {
  double sum = 0;
  for (const double step : steps) sum += step;
  std::vector<double> result = {0};
  for (const double step : steps) {
    const double share = sum > 0 ? step / sum : 1.0 / static_cast<double>(steps.size());
    result.push_back(result.back() + share * total);
  }
  return result;
}

std::vector<double> edge_lengths(const TriangleMesh& mesh, const std::vector<Vertex>& vertices,
                                 bool closed) {
  std::vector<double> lengths;
  const size_t count = vertices.size() - (closed ? 0 : 1);
  for (size_t i = 0; i < count; ++i) {
    const Vertex next = vertices[(i + 1) % vertices.size()];
    lengths.push_back((mesh.position(next) - mesh.position(vertices[i])).norm());
  }
  return lengths;
}

/// Angles at the pole between consecutive link vertices, evened out as far as needed.
std::vector<double> link_gaps(const TriangleMesh& mesh, Vertex pole,
                              const std::vector<Vertex>& link) {
  std::vector<double> gaps;
  double sum = 0;
  for (size_t i = 0; i < link.size(); ++i) {
    const Vector3 a = mesh.position(link[i]) - mesh.position(pole);
    const Vector3 b = mesh.position(link[(i + 1) % link.size()]) - mesh.position(pole);
    gaps.push_back(angle_between(a, b));
    sum += gaps.back();
  }
  const double mean = 2 * pi / static_cast<double>(link.size());
  for (double& gap : gaps) gap = sum > 0 ? gap * (2 * pi / sum) : mean;
  const auto [least, widest] = std::minmax_element(gaps.begin(), gaps.end());
  // gap ← (1−t)·gap + t·mean with the least t that keeps both bounds.
  double t = 0;
  if (*widest > widest_gap) t = (*widest - widest_gap) / (*widest - mean);
  if (*least < narrowest_gap * mean) {
    t = std::max(t, (narrowest_gap * mean - *least) / (mean - *least));
  }
  for (double& gap : gaps) gap = (1 - t) * gap + t * mean;
  return gaps;
}

ChartBoundary empty_boundary(const TriangleMesh& mesh, const CutMesh& cut_mesh,
                             double epsilon_north, double epsilon_south) {
  ChartBoundary boundary;
  boundary.roles.assign(static_cast<size_t>(mesh.vertex_count()), VertexRole::Free);
  boundary.values.theta = VectorX::Zero(mesh.vertex_count());
  boundary.values.phi = VectorX::Zero(mesh.vertex_count());
  boundary.epsilon_north = epsilon_north;
  boundary.epsilon_south = epsilon_south;
  const auto [north, south] = cut_mesh.poles();
  boundary.roles[static_cast<size_t>(north)] = VertexRole::Removed;
  boundary.roles[static_cast<size_t>(south)] = VertexRole::Removed;
  boundary.values.phi[south] = pi;
  return boundary;
}

void fix(ChartBoundary& boundary, Vertex v, double theta, double phi) {
  boundary.roles[static_cast<size_t>(v)] = VertexRole::Fixed;
  boundary.values.theta[v] = theta;
  boundary.values.phi[v] = phi;
}

void fix_link(ChartBoundary& boundary, const std::vector<Vertex>& link, double phi,
              std::vector<double> gaps) {
  const std::vector<double> theta = cumulated(std::move(gaps), 2 * pi);
  for (size_t i = 0; i < link.size(); ++i) fix(boundary, link[i], theta[i], phi);
}

}  // namespace

ChartBoundary rectangle_boundary(const TriangleMesh& mesh, const CutMesh& cut_mesh,
                                 double epsilon) {
  require_more_than("epsilon", epsilon, 0);
  require_between("epsilon", epsilon, 0, greatest_epsilon);
  ChartBoundary boundary = empty_boundary(mesh, cut_mesh, epsilon, epsilon);
  boundary.free_twist = false;
  fix_link(boundary, cut_mesh.north_link(), epsilon,
           edge_lengths(mesh, cut_mesh.north_link(), true));
  fix_link(boundary, cut_mesh.south_link(), pi - epsilon,
           edge_lengths(mesh, cut_mesh.south_link(), true));
  const std::vector<Vertex>& path = cut_mesh.date_line().path;
  const std::vector<Vertex> inner(path.begin() + 1, path.end() - 1);
  const std::vector<double> phi = cumulated(edge_lengths(mesh, inner, false), pi - 2 * epsilon);
  for (size_t i = 1; i + 1 < inner.size(); ++i) fix(boundary, inner[i], 0, epsilon + phi[i]);
  return boundary;
}

ChartBoundary cylinder_boundary(const TriangleMesh& mesh, const CutMesh& cut_mesh,
                                double epsilon_north, double epsilon_south) {
  ChartBoundary boundary = empty_boundary(mesh, cut_mesh, epsilon_north, epsilon_south);
  boundary.free_twist = true;
  const auto [north, south] = cut_mesh.poles();
  fix_link(boundary, cut_mesh.north_link(), epsilon_north,
           link_gaps(mesh, north, cut_mesh.north_link()));
  fix_link(boundary, cut_mesh.south_link(), pi - epsilon_south,
           link_gaps(mesh, south, cut_mesh.south_link()));
  return boundary;
}

HarmonicSolver::HarmonicSolver(const Topology& topology, const CutMesh& cut_mesh,
                               ChartBoundary boundary, bool symmetric, int threads)
    : topology_(topology),
      cut_mesh_(cut_mesh),
      boundary_(std::move(boundary)),
      system_(topology, boundary_.roles, symmetric, threads) {}

CurvilinearMap HarmonicSolver::solve(std::vector<double> weights, int threads) {
  system_.factorise(std::move(weights), threads);
  CurvilinearMap map = solve_factorised(threads);
  system_.forget_weights();
  return map;
}

CurvilinearMap HarmonicSolver::solve_factorised(int threads) const {
  MatrixX values(boundary_.values.theta.size(), 2);
  values << boundary_.values.theta, boundary_.values.phi;
  values = system_.solve(values, {cut_mesh_.jumps(), {}}, threads);
  CurvilinearMap map{values.col(0), values.col(1)};
  if (!boundary_.free_twist) return map;
  const double north = boundary_.epsilon_north, south = pi - boundary_.epsilon_south;
  VectorX eta = (map.phi.array() - north) / (south - north);
  const auto poles = cut_mesh_.poles();
  eta[poles.north] = eta[poles.south] = 0;
  const double twist = best_twist(map.theta, eta);
  if (!std::isfinite(twist)) throw SolveError("twist of the cylinder: no flux between its rims");
  map.theta += twist * eta;
  return map;
}

double HarmonicSolver::best_twist(const VectorX& theta, const VectorX& eta) const {
  double theta_flux = 0, eta_flux = 0;
  for (const Vertex i : cut_mesh_.south_link()) {
    topology_.for_each_outgoing(i, [&](Halfedge h) {
      const Vertex j = topology_.target(h);
      if (cut_mesh_.is_pole(j)) return;
      const double w = system_.weights()[static_cast<size_t>(h)];
      theta_flux += w * (theta[i] - theta[j] - cut_mesh_.jump(h));
      eta_flux += w * (eta[i] - eta[j]);
    });
  }
  return -theta_flux / eta_flux;
}

CurvilinearMap harmonic_map(const TriangleMesh& mesh, const Topology& topology,
                            const CutMesh& cut_mesh, const ChartBoundary& boundary, WeightKind kind,
                            int threads) {
  const EdgeWeights weights(mesh, topology, kind, threads);
  HarmonicSolver solver(topology, cut_mesh, boundary, weights.symmetric(), threads);
  return solver.solve(weights.with(topology, {}, threads), threads);
}

long planar_folds(const Topology& topology, const CutMesh& cut_mesh, const CurvilinearMap& map,
                  int threads) {
  const auto point = [&](Halfedge h) {
    const Vertex v = topology.origin(h);
    return ChartPoint{.u = map.theta[v] + 2 * pi * cut_mesh.turn(h), .v = map.phi[v]};
  };
  return static_cast<long>(
      parallel_sum(topology.face_count(), threads, [&](std::int64_t first, std::int64_t last) {
        long folds = 0;
        for (Face f = static_cast<Face>(first); f < last; ++f) {
          if (cut_mesh.removed(f)) continue;
          if (planar_orientation(point(3 * f), point(3 * f + 1), point(3 * f + 2)) <= 0) ++folds;
        }
        return static_cast<double>(folds);
      }));
}

}  // namespace sphparam
