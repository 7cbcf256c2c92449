#pragma once

#include "cli/command.h"

namespace sphparam::tools {

// Options that many subcommands have, with the same names and the same meaning in all of them.

/// --threads
void add_threads(CLI::App& command, int& threads);
/// --progress
void add_progress(CLI::App& command, ProgressStyle& progress);
/// -q and -v
void add_loudness(CLI::App& command, Loudness& loudness);

}  // namespace sphparam::tools
