#pragma once

#include <string>
#include <vector>

#include "arguments/option_table.h"

namespace sphparam::cli {

enum class Shell { Bash, Zsh, Fish };

/// A script that teaches a shell to complete subcommands, options, their words, files and folders.
std::string completion_script(Shell shell, const std::vector<CommandEntry>& table);

}  // namespace sphparam::cli
