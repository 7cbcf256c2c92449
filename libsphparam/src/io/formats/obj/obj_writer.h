#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/polygons.h"

namespace sphparam {

/// A text OBJ in shortest round-trip doubles: positions, colours, texture coordinates and normals
/// (of vertices or of corners), materials by name (faces without one after others: "(null)"),
/// comments. Other properties have no place in it.
std::string serialise_obj(const MeshFile& file);

/// The same with polygons for faces: reading it gives the mesh with these polygons cut. Requires:
/// the triangles of `file` are the polygons cut, whichever diagonals; at a vertex of a polygon all
/// its corners have the same attributes.
std::string serialise_polygon_obj(const MeshFile& file, const Polygons& faces);

/// Both, with the names of the libraries that have the materials. `faces`: null for triangles.
std::string serialise_obj(const MeshFile& file, const Polygons* faces,
                          const std::vector<std::string>& libraries);

}  // namespace sphparam
