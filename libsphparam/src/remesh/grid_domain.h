#pragma once

#include "sphparam/io/polygons.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

/// Polygons cut into fans. Any cut will do where only directions matter.
Triangles as_triangles(const Polygons& faces);

/// What is asked of a grid of one's own before anything is looked up at it: that it is a sphere is
/// certified of what is made. Throws: MeshError for no faces, and for those of vertices that are
/// not there; std::invalid_argument for a direction that is zero or not finite.
void require_domain(const SphereGrid& grid);

}  // namespace sphparam
