#pragma once

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Brings colours of vertices and faces that programs write in other ways to the conventions of
/// MeshFile, and notes it: properties diffuse_red and so on (old MeshLab and Blender) get their
/// names where no `red` is there; real numbers from 0 to 255 (all columns go beyond 1 and one
/// beyond 16, as light hardly does, or all numbers are whole and one goes beyond 1) become bytes
/// where they are whole, fractions where not.
void take_other_colours(MeshFile& file);

}  // namespace sphparam
