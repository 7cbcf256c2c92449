#pragma once

#include <string>

namespace CLI {
class App;
}

namespace sphparam::cli {

/// Notes every file that the options of a subcommand name, but for those that are named to be
/// written: no output may replace them. There is one list, of the options that write (in
/// files_read.cpp); whatever else names a file is taken for read, also as NAME=FILE or like:FILE.
/// So an option that is forgotten there can only refuse too much, and does so at once.
/// To be called once, with the command line parsed and before any work.
/// Throws: UsageMistake where an option writes what another one reads, however spelled, also
/// through symbolic and hard links.
void note_files_read(const CLI::App& command);

/// Throws UsageMistake where `output`, which exists and is no device, is one of these files.
void require_not_read(const std::string& option, const std::string& output);

}  // namespace sphparam::cli
