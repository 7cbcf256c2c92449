#pragma once

#include "sphparam/baselines/baseline_result.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"

namespace sphparam {

struct ConformalOptions {
  int max_iterations = 5000;  // ≥ 0, of each of the two descents
  /// 0 to 1; a descent ends when a step lowers its energy by a smaller share.
  double least_gain = 1e-7;
  int threads = 0;  // 0: all cores
};

/// Harmonic maps to the sphere by descent: Gu and Yau, "Computing conformal structures of surfaces"
/// (2002) and "Global conformal surface parameterization" (2003), the paper's references [8, 9].
///
/// Starts from the Gauss map; lowers the Tutte energy Σ |x_i − x_j|², then the harmonic energy
/// Σ w_ij |x_i − x_j|² with cotangent weights, along the gradient in the tangent planes; after
/// every step a Möbius transformation puts the centre of mass (of the source's area) into the
/// centre. Ours: the gradient of a vertex is divided by its Σ|w|, and the step is as long as the
/// energy allows, so that no δt has to be found by hand. Cotangents as in `map_stereographic`.
/// Ensures: centre of mass within 1e-9 of zero, but for maps that cannot be centred (half of the
/// mass in one point); same bits for any number of threads. Requires: closed genus-0 mesh.
/// Throws: Cancelled. Cost: about 0.02 µs a triangle and iteration; the number of iterations grows
/// with that of the vertices, on long protrusions much faster.
BaselineResult map_conformal(const TriangleMesh& mesh, const Topology& topology,
                             const ConformalOptions& options = {}, const Progress& progress = {});

}  // namespace sphparam
