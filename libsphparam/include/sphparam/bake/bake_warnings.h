#pragma once

#include <string>
#include <vector>

#include "sphparam/bake/bake.h"

namespace sphparam {

/// What `bake` warns of that is wrong with the values of these fields, whatever is made of them,
/// for who takes them by `bake_values`: a mesh that is inside out, a centre outside of it; with a
/// body a mesh in another unit, and a map that is radial about another centre.
/// Cost: some passes over the mesh.
std::vector<std::string> bake_warnings(const MappedMesh& source,
                                       const std::vector<std::string>& fields,
                                       const BakeSettings& settings);

}  // namespace sphparam
