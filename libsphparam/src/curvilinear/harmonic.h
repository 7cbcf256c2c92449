#pragma once

#include "curvilinear/cut_mesh.h"
#include "mesh/laplace_system.h"
#include "sphparam/mesh/edge_weights.h"

namespace sphparam {

/// Longitude and polar angle of every vertex, on the eastern bank of the date line: a wedge has
/// θ(vertex) + 2π·turn. θ of the poles is 0.
struct CurvilinearMap {
  VectorX theta;  // #V, radians, any real numbers
  VectorX phi;    // #V, radians, 0 at the north pole, π at the south pole
};

/// What is prescribed at the rims of the chart, and which vertices are left to the equation.
struct ChartBoundary {
  std::vector<VertexRole> roles;  // #V; poles are removed
  CurvilinearMap values;          // read at fixed vertices
  double epsilon_north;           // ϕ of the north link
  double epsilon_south;           // π − ϕ of the south link
  bool free_twist;                // may the south link turn against the north one?
};

/// Of the rims about the poles, radians: below π/2, where they meet.
constexpr double greatest_epsilon = 1.5;

/// The paper's rectangle [0, 2π] × [ε, π−ε] with all four sides fixed: θ = 0 (and 2π) and ϕ in
/// proportion to arc length on the date line; ϕ = ε, π−ε and θ in proportion to arc length on the
/// links.  Paper: Section 3, ε = 0.02. Throws: std::invalid_argument unless 0 < ε ≤ 1.5.
ChartBoundary rectangle_boundary(const TriangleMesh& mesh, const CutMesh& cut_mesh, double epsilon);

/// A cylinder: the date line is free, θ has period 2π across it. On each link ϕ is fixed and θ
/// grows with the corner angles at the pole, as an exponential map would have it; gaps are evened
/// out until all are at most 0.9π (an edge longer than half a turn would go the other way round on
/// the sphere) and none is smaller than a thousandth of the mean. The links may turn against each
/// other by one unknown, the twist.
/// Our own; Tutte's theorem on a cylinder is due to Groiss, Jüttler, Mokriš (2021), the free date
/// line to Brechbühler et al. (the paper's reference [2]).
/// Requires: chord-free pole links, symmetric weights later.
ChartBoundary cylinder_boundary(const TriangleMesh& mesh, const CutMesh& cut_mesh,
                                double epsilon_north, double epsilon_south);

/// Solves ∇²U = 0 for U = θ and U = ϕ with one factorisation; again and again with other weights.
///
/// With a free twist c, θ = θ₀ + c·η, η = (ϕ−ε_N)/(π−ε_N−ε_S), where c minimises the Dirichlet
/// energy ½ Σ_edges w (Δθ)².
class HarmonicSolver {
 public:
  /// Requires: topology and cut mesh outlive the solver; usable poles.
  HarmonicSolver(const Topology& topology, const CutMesh& cut_mesh, ChartBoundary boundary,
                 bool symmetric, int threads = 0);
  HarmonicSolver(const Topology&&, const CutMesh&, ChartBoundary, bool, int = 0) = delete;
  HarmonicSolver(const Topology&, const CutMesh&&, ChartBoundary, bool, int = 0) = delete;
  HarmonicSolver(const Topology&&, const CutMesh&&, ChartBoundary, bool, int = 0) = delete;

  /// weights: w[h] per half-edge, see EdgeWeights. Throws: SolveError; never for positive weights
  /// of a reasonable range.
  CurvilinearMap solve(std::vector<double> weights, int threads = 0);

 private:
  CurvilinearMap solve_factorised(int threads) const;
  double best_twist(const VectorX& theta, const VectorX& eta) const;

  const Topology& topology_;
  const CutMesh& cut_mesh_;
  ChartBoundary boundary_;
  LaplaceSystem system_;
};

/// The initial map.  Paper: Section 3, Equation 1.
CurvilinearMap harmonic_map(const TriangleMesh& mesh, const Topology& topology,
                            const CutMesh& cut_mesh, const ChartBoundary& boundary, WeightKind kind,
                            int threads = 0);

/// Number of triangles of the disk that are not strictly counter-clockwise in the chart, with exact
/// signs of the doubles θ + 2π·turn and ϕ. Zero: the planar map is one-to-one.
long planar_folds(const Topology& topology, const CutMesh& cut_mesh, const CurvilinearMap& map,
                  int threads = 0);

}  // namespace sphparam
