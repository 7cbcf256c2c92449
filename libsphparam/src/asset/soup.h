#pragma once

#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// The file of an asset without the vertices that have no place, and their triangles.
MeshFile with_places(const MeshSource& asset);

/// Of the box about a mesh; 0 without vertices.
double longest_side(const TriangleMesh& mesh);

}  // namespace sphparam
