#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// A binary little-endian PLY with all that the mesh file carries: properties in their own types,
/// corner texture coordinates as the face list `texcoord`, corner normals as the face list
/// `normal`, comments, and materials as comments. Reading it gives the same mesh file.
///
/// No bit is lost: numbers that their type does not hold exactly are written as doubles.
/// Requires: finite numbers; property names without blanks. Cost: near a copy of the bytes.
std::string serialise_ply(const MeshFile& file);

/// All of that up to the faces, whose declarations are given: their records, of `face_bytes` in
/// all, follow.
std::string ply_up_to_faces(const MeshFile& file, const std::string& face_declarations,
                            std::size_t face_bytes);

}  // namespace sphparam
