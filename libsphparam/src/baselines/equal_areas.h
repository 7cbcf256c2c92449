#pragma once

#include <vector>

#include "baselines/vertex_system.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// The optimisation of `map_brechbuehler`: its variables are moves in the tangent planes.
class EqualAreas {
 public:
  /// shares: of the sphere's 4π, per face, positive. Requires: the topology outlives this.
  EqualAreas(const Topology& topology, std::vector<double> shares, int threads);

  /// ρ/2 Σ (Ω − A)²/A − Σ cos(side).
  double merit(const SphereMap& map, double penalty) const;
  /// 1 per triangle with an angle that is not positive.
  std::vector<char> negative_angles(const SphereMap& map) const;
  /// Root of the mean of (Ω − A)²/A over the sphere, 0 for equal areas.
  double area_error(const SphereMap& map) const;

  /// The Gauss–Newton step with Levenberg–Marquardt damping; two numbers a vertex.
  /// active: per face, 1 where the area may not change (to first order). Throws: SolveError.
  VectorX step(const SphereMap& map, double penalty, double damping,
               const std::vector<char>& active);
  SphereMap moved(const SphereMap& map, const VectorX& step) const;

 private:
  double area_term(const SphereMap& map) const;
  void add_sides(const SphereMap& map);
  void add_areas(const SphereMap& map, double penalty, double damping,
                 const std::vector<char>& active);

  const Topology& topology_;
  std::vector<double> shares_;
  int threads_;
  VertexSystem system_;
  // The system of the step at hand.
  std::vector<double> diagonal_, off_diagonal_;
  VectorX force_;
};

}  // namespace sphparam
