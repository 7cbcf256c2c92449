#pragma once

#include <string>

#include "console/console.h"
#include "sphparam/io/mapped_mesh.h"

namespace sphparam::cli {

/// Warns that the fillers of a mesh, if it has any, count as surface in `what`, with their share.
void tell_counted_fillers(const MappedMesh& mapped, const std::string& what, Console& console);

}  // namespace sphparam::cli
