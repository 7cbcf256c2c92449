#pragma once

#include "sphparam/embedding/distortion_energy.h"

namespace sphparam {

/// The rest triangles with another area to aim at: `density` times as much of the sphere per area
/// of the surface, in all 4π. Shapes stay, so angles count as before; only the area term of the
/// energy, and the weight of each triangle in it, feel the difference.
///
/// density: #V, of any unit; a triangle has the mean of its corners'. The same number everywhere
/// gives back the bytes of `source`. Requires: finite and positive.
/// Throws: std::invalid_argument if not. Cost: one pass. Our own.
RestTriangles with_density(const Topology& topology, RestTriangles source, const VectorX& density);

}  // namespace sphparam
