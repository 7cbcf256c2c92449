#pragma once

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/mesh_repair.h"

namespace sphparam {

/// Gives what a repair put in the texture of what is beside it.
///
/// Where all that surrounds faces which close a hole lies in one piece of the atlas, texture
/// coordinates run on between its borders; where a seam of the atlas ends at the hole, each of the
/// faces shows what is along the nearest piece of its rim, and has its material. Faces that were
/// joined across a seam, by turning a diagonal, keep to the face that they have most of.
/// Fillers are no surface and stay as they are.
///
/// `input`: the texture coordinates of the corners of `before`.
/// Requires: `mended` is `before`, mended, with a table of corner texture coordinates in which
/// corners have those that they are like.
/// Ensures: deterministic. Cost: O(#F), and of the faces put in O(n log n).
void texture_patches(MeshFile& mended, const MeshFile& before, const CornerTexcoords& input,
                     const RepairedMesh& repaired);

}  // namespace sphparam
