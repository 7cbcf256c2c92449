#pragma once

#include <string>

#include "commands/source.h"
#include "console/console.h"

namespace sphparam::cli {

/// Says what the file carries and the mesh file does not, a line each. Every command whose outputs
/// carry what a mesh carries calls it.
void tell_losses(const MeshSource& source, const std::string& path, Console& console);

}  // namespace sphparam::cli
