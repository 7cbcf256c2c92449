#pragma once

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// What the comments of another file say of the volume that a surface of FreeSurfer lies in,
/// instead of what they said: viewers add its centre to the coordinates.
void take_volume(MeshFile& file, const MeshFile& other);

/// Brings the vertices to places in the coordinates of another mesh: what points up and the volume
/// are as its comments say; normals and tangents, which were of the old shape, go. Positions were
/// computed in doubles, and are written so.
void move_into(MeshFile& file, const MeshFile& other, Points positions);

}  // namespace sphparam
