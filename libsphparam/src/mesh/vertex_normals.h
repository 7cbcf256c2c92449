#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Unit normals, the mean of the faces' weighted by area; +z where that is zero. #V×3.
/// Requires: finite positions, of any size.
Points vertex_normals(const TriangleMesh& mesh);

/// The same, weighted by the faces' angles at the vertex: the same direction however the surface
/// is cut into triangles, and between the two where a narrow face bevels an edge, where the mean by
/// area takes the wide faces' and leaves the whole turn to the bevel. Source: Thürmer and Wüthrich,
/// "Computing vertex normals from polygonal facets" (1998).
Points angle_weighted_normals(const TriangleMesh& mesh);

}  // namespace sphparam
