#pragma once

#include <string>

#include "console/console.h"
#include "commands/source.h"

namespace sphparam::cli {

/// Says what the file carries and the mesh file does not, a line each. Every command whose outputs
/// carry what a mesh carries calls it.
void tell_losses(const MeshSource& source, const std::string& path, Console& console);

}  // namespace sphparam::cli
