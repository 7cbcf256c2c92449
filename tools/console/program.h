#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sphparam::cli {

/// The program: what `main` is called with → its exit code. Sets the signal handlers and limits of
/// the whole process, and is to be called once in it.
int run_sphparam(int argc, char** argv);

/// Another command line in a process that was forked from such a one for it: the words after the
/// name of the program → the exit code. `presets`: options with their values, for a subcommand that
/// has them and words that do not say them. `no_room`: the code where the machine has no room for
/// what is written, instead of that of files.
int run_command_line(std::vector<std::string> words,
                     const std::vector<std::pair<std::string, std::string>>& presets, int no_room);

/// Which of the words of a command line name files that it would read. Nothing is run.
/// Throws: UsageMistake where the words make no sense.
std::vector<std::string> files_read_by(const std::vector<std::string>& words);

/// Those that it would write, there or not. Throws: as `files_read_by`.
std::vector<std::string> files_written_by(const std::vector<std::string>& words);

}  // namespace sphparam::cli
