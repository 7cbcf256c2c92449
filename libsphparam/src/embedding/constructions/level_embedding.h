#pragma once

#include <limits>

#include "embedding/constructions/progressive.h"

namespace sphparam {

/// What one embedding of several may leave to others.
struct StartOptions {
  /// Where sweeps do not suffice and the energy is more than so many times an isometry's, the
  /// finest level gets no steps: `report.demanding` says so, and nothing for sure what is left.
  double demanding = std::numeric_limits<double>::infinity();
  /// μ, by which rest triangles count as fatter than they are (rest_floors.h), but for what pins
  /// and fillers are placed by.
  double fatness = 0;
  int most_blocked = 0;  // as in RefinementOptions
};

/// One embedding from coarse to fine, by the energy and the quality asked for; what
/// `embed_progressively` is made of. No map: a vertex found no room although its level was retried.
/// Requires: `options` within their domain, but that `least_area` may be more than 1: then all
/// triangles are alike, and the smallest weigh more; `keep` has the pins. Throws: Cancelled.
/// Cost: O(#F). Source: see progressive.h.
ProgressiveEmbedding embed_by_levels(const TriangleMesh& mesh, const Topology& topology,
                                     const ProgressiveOptions& options, const KeptVertices& keep,
                                     const StartOptions& how = {});

}  // namespace sphparam
