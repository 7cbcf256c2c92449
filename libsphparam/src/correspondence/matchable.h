#pragma once

#include <optional>
#include <string>

#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// Throws: UnmeasurableMesh, with the mesh's name, where there is no area, or more than doubles
/// hold.
void require_area(const MappedMesh& mapped);

/// What is told where the faces of one surface look outward and those of the other inward: maps
/// keep the sense in which faces run, so that the map between them mirrors. Nothing where either
/// encloses next to nothing, or is a sheet (`is_sheet`). Cost: some passes over the faces.
std::optional<std::string> opposite_facing(const MappedMesh& from, const MappedMesh& to);

}  // namespace sphparam
