#pragma once

#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// Of all triangles; sums in the order of the faces.
double surface_area(const TriangleMesh& mesh);

/// A third of the area of the triangles round each vertex.
VectorX areas_round_vertices(const TriangleMesh& mesh);

/// Where the vertices are in space, from the centre of the area, in units of √area. Of two surfaces
/// that lie alike, places that correspond are near each other.
Points stance_of(const TriangleMesh& mesh);

/// Throws: UnmeasurableMesh, with the mesh's name, where there is no area, or more than doubles
/// hold.
void require_area(const MappedMesh& mapped);

}  // namespace sphparam
