#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/polygons.h"

namespace sphparam {

/// A binary PLY as `serialise_ply` makes it, with polygons for faces: reading it gives the mesh
/// file back, whose triangles are those polygons cut. Requires: the triangles of `file` are what
/// `adopt_triangulation` made of `faces`.
std::string serialise_polygon_ply(const MeshFile& file, const Polygons& faces);

}  // namespace sphparam
