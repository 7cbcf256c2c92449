#pragma once

#include "sphparam/io/polygons.h"
#include "sphparam/remesh/limit_surface.h"

namespace sphparam {

/// Where the vertices of a grid lie on its limit surface.
struct LimitVertices {
  Points positions, normals;  // unit, outwards
  VectorX mean, gauss;        // curvature: of a sphere of radius r, 1/r and 1/r²
};

/// Normals and curvatures are means over the patches about a vertex, which agree where the valence
/// is the usual one (6 by Loop's scheme, 4 by Catmull's and Clark's): there they are exact. At
/// other vertices the schemes have no curvature, or an infinite one; that of the patches half way
/// between the vertex and their middles is taken.
LimitVertices limit_at_vertices(const LimitSurface& surface, const Polygons& faces,
                                int threads = 0);

}  // namespace sphparam
