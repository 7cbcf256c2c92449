#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// A mesh file with a number for each vertex, as the property `name` and as colours (red green
/// blue) from 0 to the largest; where some are less than 0, blue to red about 0, as far both ways.
/// Properties of these names are replaced, and textures left out, which would be seen instead.
/// `about`: what the numbers are; where it is given, a comment says so, and what the colours mean.
/// Requires: a finite number a vertex. Cost: linear.
MeshFile with_coloured_values(MeshFile file, const std::string& name, const VectorX& values,
                              const std::string& about = "");

}  // namespace sphparam
