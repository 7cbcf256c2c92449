#pragma once

#include <string>

#include "cli/console.h"
#include "cli/source.h"

namespace sphparam::tools {

/// Says what the file carries and the mesh file does not, a line each. Every command whose outputs
/// carry what a mesh carries calls it.
void tell_losses(const Source& source, const std::string& path, Console& console);

}  // namespace sphparam::tools
