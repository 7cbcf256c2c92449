#pragma once

#include <optional>
#include <vector>

#include "embedding/frame/landmarks.h"
#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// The map that a surface has, turned, with its landmarks exactly there, where that is hardly a
/// change: two maps that mean the same. Without landmarks as it is.
/// Nothing: they are elsewhere, or fold a triangle.
std::optional<SphereMap> fitting_map(const MappedMesh& from, const std::vector<Pin>& pins);

}  // namespace sphparam
