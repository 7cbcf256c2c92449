#pragma once

#include <string>

#include "mesh_io/mesh_file.h"
#include "mesh_io/polygons.h"

namespace sphparam::tools {

/// A binary PLY as `serialise_ply` makes it, with polygons for faces: reading it gives the mesh
/// file back, whose triangles are those polygons cut. Requires: the triangles of `file` are what
/// `adopt_triangulation` made of `faces`.
std::string serialise_polygon_ply(MeshFile file, const Polygons& faces);

}  // namespace sphparam::tools
