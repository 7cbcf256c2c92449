#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The size of a surface: RMS distance of its points from their centroid, both by area; exact
/// integrals over the triangles, so that it does not depend on how the surface is cut into them.
///
/// Requires: vertices that are there. Ensures: of a surface c times as large c times that, of one
/// moved and turned the same; 0 of one without area. Cost: two passes over the triangles.
/// Source: the centroid size of landmarks (Bookstein, "Morphometric tools for landmark data",
/// 1991), as a mean, with all points of a surface for landmarks.
double surface_size(const TriangleMesh& surface);

}  // namespace sphparam
