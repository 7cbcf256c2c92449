#pragma once

#include "embedding/constructions/progressive.h"

namespace sphparam {

/// One embedding from coarse to fine, by the energy and the quality asked for; what
/// `embed_progressively` is made of. No map: a vertex found no room although its level was retried.
/// Where sweeps do not suffice and the energy is more than `demanding` times an isometry's, the
/// finest level gets no steps: `report.demanding` says so, and nothing for sure what is left.
/// Requires: `options` within their domain; `keep` has the pins. Throws: Cancelled.
/// Cost: O(#F). Source: see progressive.h.
ProgressiveEmbedding embed_by_levels(const TriangleMesh& mesh, const Topology& topology,
                                     const ProgressiveOptions& options, const KeptVertices& keep,
                                     double demanding);

}  // namespace sphparam
