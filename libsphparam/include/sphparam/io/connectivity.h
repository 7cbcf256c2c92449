#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Why two meshes are not one connectivity, the same vertices in every triangle, for people; empty
/// when they are. Triangles may be rotated. `source` is the mesh, `sphere` what should be its
/// sphere.
///
/// Where the sphere's file has polygons, reading cut them by the places of its vertices, which says
/// nothing: such a polygon may be cut in another way in the source, whose cut then holds for both.
std::string connectivity_difference(const MeshFile& source, const MeshFile& sphere);

/// How many of the sphere's polygons are cut in another way than the source's. Requires: the two
/// are one connectivity.
long cut_otherwise(const MeshFile& source, const MeshFile& sphere);

}  // namespace sphparam
