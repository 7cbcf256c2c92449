#pragma once

#include <string>

#include "console/console.h"
#include "sphparam/io/mapped_mesh.h"

namespace sphparam::cli {

/// Warns that the fillers of a mesh, if it has any, count as surface in `what`, with their share.
void tell_counted_fillers(const MappedMesh& mapped, const std::string& what, Console& console);

/// Warns where a mesh on a grid has not the holes of its source, with the area that went.
void tell_changed_holes(const MappedMesh& source, const MappedMesh& made, Console& console);

}  // namespace sphparam::cli
