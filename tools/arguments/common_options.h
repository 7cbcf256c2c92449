#pragma once

#include <string>
#include <vector>

#include "commands/command.h"

namespace sphparam::cli {

// Options that many subcommands have, with the same names and the same meaning in all of them.

/// --threads
void add_threads(CLI::App& command, int& threads);
/// --progress
void add_progress(CLI::App& command, ProgressStyle& progress);
/// --json FILE, - for standard output. `what`: what is in it.
void add_json(CLI::App& command, std::string& json, const std::string& what = "A report");
/// Throws: as `check_places` for that file; UsageMistake for the name of a mesh: where --json was a
/// flag once, the word behind it is a mesh, which must not be lost.
void require_report_place(const std::vector<std::string>& inputs, const std::string& json);
/// -q and -v
void add_loudness(CLI::App& command, Loudness& loudness);

}  // namespace sphparam::cli
