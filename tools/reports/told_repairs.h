#pragma once

#include "console/console.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam::cli {

/// Says what was done to a mesh: each kind of repair, the handles, what choosing a component
/// kept, what was put in.
void tell_repairs(const MeshSource& source, Console& console);

}  // namespace sphparam::cli
