#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The axis of a mesh that points up.
enum class Up { Z, Y };

/// What a file says of it: y where the mesh was read from glTF, whose standard says so, or comes
/// from such a mesh by way of other files, since a comment keeps it; else z.
Up up_axis(const MeshFile& file);

/// The comment that says that y is up.
std::string comment_of_y_up();

/// The axis as a unit vector.
Vector3 direction_of(Up up);

}  // namespace sphparam
