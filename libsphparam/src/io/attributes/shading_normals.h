#pragma once

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// The normals that a mesh is lit with, one a vertex, unit: those of the file (nx ny nz; the mean
/// of its corners' where they are there), else the mean of the faces', weighted by area; +z where
/// that is zero. Whoever bakes in a tangent frame and whoever writes one must take these. #V×3.
Points shading_normals(const MeshFile& file);

}  // namespace sphparam
