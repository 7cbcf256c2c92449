#pragma once

#include <optional>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// The normals that a mesh is lit with, one a vertex, unit: those of the file (nx ny nz; the mean
/// of its corners' where they are there), else the mean of the faces', weighted by area; +z where
/// that is zero. Whoever bakes in a tangent frame and whoever writes one must take these. #V×3.
Points shading_normals(const MeshFile& file);

/// The same of corners, 3·#F rows, unit, where the file has normals there; those of `of_vertices`
/// (`shading_normals` of the file) where a corner's own is zero or not finite. Nothing where the
/// file has none: hard edges are where these differ about a vertex.
std::optional<CornerNormals> corner_shading_normals(const MeshFile& file,
                                                    const Points& of_vertices);

}  // namespace sphparam
