#pragma once

#include <optional>

#include "sphparam/io/up_axis.h"

namespace CLI {
class App;
}

namespace sphparam::cli {

/// --up, the same wherever a mesh is drawn or exported; nothing: as its file says.
void add_up(CLI::App& command, std::optional<Up>& up);

}  // namespace sphparam::cli
