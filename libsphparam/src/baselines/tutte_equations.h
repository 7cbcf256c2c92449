#pragma once

#include "baselines/vertex_system.h"
#include "baselines/weighted_rings.h"
#include "sphparam/progress.h"

namespace sphparam {

struct TutteSolution {
  SphereMap map;
  double residual = 1;        // as a share of the first map's
  double first_residual = 0;  // in the norm of tutte_equations.cpp
  int sweeps = 0, steps = 0;
};

/// Σ_j w_ij x_j = α_i x_i, |x_i| = 1: Tutte's equations on the sphere.
/// They are solved up to a force along Möbius transformations, see tutte_equations.cpp.
/// Paper: Gotsman, Gu, Sheffer, "Fundamentals of spherical parameterization for 3D meshes" (2003).
class TutteEquations {
 public:
  /// weights: per half-edge, symmetric. Requires: the topology outlives the equations.
  TutteEquations(const Topology& topology, const std::vector<double>& weights);

  /// Projected Gauss–Seidel, as long as the residual falls.
  TutteSolution sweep(SphereMap map, int max_sweeps, const Progress& progress) const;

  /// Damped Newton steps. Ensures: the residual does not rise. Throws: SolveError.
  TutteSolution newton(TutteSolution solution, int max_steps, double tolerance,
                       const Progress& progress) const;

 private:
  std::vector<double> image_areas(const SphereMap& map) const;
  double residual(const SphereMap& map) const;
  VectorX newton_step(VertexSystem& system, const SphereMap& map) const;

  const Topology& topology_;
  std::vector<double> weights_;
  WeightedRings rings_;
  std::vector<double> totals_;  // Σ_j |w_ij|
};

}  // namespace sphparam
