#pragma once

#include "correspondence/moving_surface.h"
#include "mesh/mesh_hierarchy.h"

namespace sphparam {

/// Puts a vertex, which has a place in the kernel of its ring, to where it lies in its ring on the
/// source, as far as the target has such a place: of those that walks from its place and from those
/// of the ring reach, the one at which the energy of its ring is least. Requires: a complete level.
void put_into_ring(MovingSurface& surface, const HierarchyLevel& level, Vertex v,
                   const ComposedEnergy& energy);

}  // namespace sphparam
