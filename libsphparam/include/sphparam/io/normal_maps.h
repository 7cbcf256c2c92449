#pragma once

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Says of all normal maps of a mesh that their green points down the image, as DirectX has it, and
/// not up, as glTF: files do not say which. Maps of heights stay what they are. Twice is as before.
/// How many materials have one; 0: nothing is changed.
long turn_normal_maps_over(MeshFile& file);

}  // namespace sphparam
