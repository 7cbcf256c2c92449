#pragma once

#include <string>
#include <vector>

#include "sphparam/bake/bake.h"

namespace sphparam {

/// What looks wrong with a mesh whose fields are baked: it is inside out; the centre that they are
/// measured from lies outside of it. None of another surface that is baked on it.
std::vector<std::string> doubts_about(const MappedMesh& source,
                                      const std::vector<std::string>& fields,
                                      const BakeSettings& settings);

}  // namespace sphparam
