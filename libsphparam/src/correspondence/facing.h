#pragma once

#include <optional>
#include <string>

#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// What is told where the faces of one surface look outward and those of the other inward: maps
/// keep the sense in which faces run, so that the map between them mirrors. Nothing where either
/// encloses next to nothing, as sheets do whose holes are kept. Cost: a pass over the faces.
std::optional<std::string> opposite_facing(const MappedMesh& from, const MappedMesh& to);

}  // namespace sphparam
