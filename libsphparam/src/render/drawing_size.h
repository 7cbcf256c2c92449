#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The mesh in numbers that can be drawn, by this renderer and by others in single precision: as it
/// is where its coordinates stay within 2⁶⁰ and its extent is at least 2⁻⁶⁰; else moved to the
/// origin and scaled by a power of two to about unit size. Pictures do not depend on size.
/// Requires: finite positions. Ensures: the same for a mesh that is one point.
TriangleMesh at_drawing_size(TriangleMesh mesh);

}  // namespace sphparam
