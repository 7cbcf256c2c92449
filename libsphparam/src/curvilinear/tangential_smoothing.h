#pragma once

#include <vector>

#include "sphparam/curvilinear/date_line.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

struct SmoothingOptions {
  int rings = 5;   // ≥ 0; the sub-patch: all vertices within so many edges of the date line
  int sweeps = 3;  // ≥ 0; "in all our experiments three iterations revealed to be sufficient"
  /// The operator 𝓛: mean value weights, which keep features along the date line, or uniform ones.
  enum class Operator { MeanValue, Uniform } laplacian = Operator::MeanValue;
  int threads = 0;  // of the weights; 0: all cores
};

/// Relaxes the map along the date line, vertex after vertex in place:
///   x_i ← x_i + 𝓛(x_i) − ⟨𝓛(x_i), x_i⟩ x_i,   x_i ← x_i / ‖x_i‖.
/// Paper: Section 5, to the letter; the vertices are taken ring by ring from the date line, poles
/// included. It may fold triangles, the paper's "no risk" notwithstanding; `certify` tells.
/// Throws: std::invalid_argument naming an option outside of its domain.
SphereMap smooth_date_line(const TriangleMesh& mesh, const Topology& topology,
                           const DateLine& date_line, SphereMap map,
                           const SmoothingOptions& options = {});

/// All vertices within `rings` edges of the date line, ring by ring.
std::vector<Vertex> date_line_patch(const Topology& topology, const DateLine& date_line, int rings);

}  // namespace sphparam
