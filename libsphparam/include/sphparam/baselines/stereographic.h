#pragma once

#include <optional>

#include "sphparam/baselines/baseline_result.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"

namespace sphparam {

struct StereographicOptions {
  std::optional<Face> cut = std::nullopt;  // the triangle around infinity; without: see below
  int threads = 0;                         // of the weights; 0: all cores
};

/// Conformal to the plane, then to the sphere: Haker, Angenent, Tannenbaum, Kikinis, Sapiro, Halle,
/// "Conformal surface parameterization for texture mapping" (2000), the paper's reference [10].
///
/// ΔU = (∂/∂u − i ∂/∂v) δ_p with p in the triangle that is cut, discretised by linear elements:
/// cotangent weights, a right side at the three corners, two solves. Then the inverse of the
/// stereographic projection, after translation by the medians of both coordinates and scaling by
/// the median distance from there, so that each hemisphere has half of the vertices.
/// Where the authors leave the triangle to the user, ours is the least distorting kind of guess:
/// the largest of those with angles between 30° and 120° (of all, if there is none). Cotangents are
/// as they come, negative ones included; only areas below 1e-12 of a longest edge squared are
/// floored.
/// Ensures: same bits for any number of threads. Requires: closed genus-0 mesh.
/// Throws: Cancelled. Cost: one factorisation of #V unknowns.
BaselineResult map_stereographic(const TriangleMesh& mesh, const Topology& topology,
                                 const StereographicOptions& options = {},
                                 const Progress& progress = {});

}  // namespace sphparam
