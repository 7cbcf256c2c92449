#pragma once

#include "sphparam/baselines/baseline_result.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"

namespace sphparam {

struct FlowOptions {
  int max_steps = 100;      // ≥ 0
  double time_step = 0.05;  // > 0, of a surface of area 4π
  /// ≥ 0; done when radii deviate by less from their mean, root mean square.
  double roundness = 1e-3;
  int threads = 0;  // 0: all cores
};

/// Conformalised mean curvature flow: Kazhdan, Solomon, Ben-Chen, "Can mean-curvature flow be
/// modified to be non-singular?" (2012); the modern form of the paper's references [8, 9].
///
/// (M_t + δ L₀) x_{t+1} = M_t x_t with the cotangent matrix L₀ of the source and the mass matrix
/// M_t of the moving surface, which is scaled to area 4π and centred after every step. In the end
/// its points go to the sphere around the centre and a Möbius transformation puts the centre of
/// mass (of the source's area) there, as Baden, Crane, Kazhdan, "Möbius registration" (2018), do.
/// Cotangents as in `map_stereographic`.
/// Ensures: as `map_conformal`. Requires: closed genus-0 mesh. Throws: Cancelled.
/// Cost: a factorisation of #V unknowns a step.
BaselineResult map_flow(const TriangleMesh& mesh, const Topology& topology,
                        const FlowOptions& options = {}, const Progress& progress = {});

}  // namespace sphparam
