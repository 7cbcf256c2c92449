#pragma once

#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Leaves properties out that have a value which is not finite, and notes the loss: programs write
/// that for vertices and faces that have none. A vector that lacks a component is none: those that
/// go with it are left out too. `of_vertices`: else of faces.
/// Throws: ReadError where it is a ray's, for a map that lacks one is no map, and must not be taken
/// for a mesh without one.
void leave_out_non_finite(std::vector<Property>& properties, bool of_vertices,
                          const std::string& name, std::vector<std::string>& notes);

}  // namespace sphparam
