#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

struct Polygons;

/// A binary little-endian PLY with all that the mesh file carries: properties in their own types,
/// corner texture coordinates as the face list `texcoord`, corner normals as the face list
/// `normal`, comments, and materials as comments. Reading it gives the same mesh file.
///
/// No bit is lost: numbers that their type does not hold exactly are written as doubles.
/// Requires: finite numbers; property names without blanks. Cost: near a copy of the bytes.
std::string serialise_ply(const MeshFile& file);

/// A text OBJ in shortest round-trip doubles: positions, colours, texture coordinates and normals
/// (of vertices or of corners), materials by name, comments. Other properties have no place in it.
std::string serialise_obj(const MeshFile& file);

/// The same with polygons for faces: reading it gives the mesh with these polygons cut. Requires:
/// the triangles of `file` are the polygons cut, whichever diagonals; at a vertex of a polygon all
/// its corners have the same attributes.
std::string serialise_polygon_obj(const MeshFile& file, const Polygons& faces);

/// A text OFF in shortest round-trip doubles: positions and, named by the keyword, normals, colours
/// and texture coordinates of vertices; face colours; comments.
std::string serialise_off(const MeshFile& file);

/// `declared` where it holds every number exactly, else Float64.
ScalarType lossless_type(ScalarType declared, const double* values, Eigen::Index count);

}  // namespace sphparam
