#pragma once

#include <string>
#include <vector>

#include "arguments/option_table.h"

namespace sphparam::cli {

/// The manual page sphparam(1), as roff with the man macros: every command with its examples and
/// options, the files, the environment and the exit codes.
std::string manual_page(const std::vector<CommandEntry>& table);

}  // namespace sphparam::cli
