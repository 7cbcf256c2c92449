#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace sphparam::cli {

/// What the program is for, with examples.
extern const char program_summary[];

/// Gives the program the shape that its help has here: no remarks in descriptions, the first line
/// of each subcommand's in their list, and the exit codes at the end.
void shape_help(CLI::App& program);

}  // namespace sphparam::cli
