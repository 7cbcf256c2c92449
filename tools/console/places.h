#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/paths.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sphparam::cli {

/// Says of an option that the files it names are written. All others that name a file are taken for
/// read, also as NAME=FILE or like:FILE: one that is forgotten here can only refuse too much, and
/// does so at once.
void mark_written(const CLI::Option& option);

/// Notes every file that the options of a subcommand name and do not write: no output may replace
/// them. To be called once, with the command line parsed and before any work.
/// Throws: UsageMistake where an option writes what another one reads, however spelled, also
/// through symbolic and hard links.
void note_files_read(const CLI::App& command);

/// Notes files that no option names, as those of a folder: `check_places` asks for them after it.
void note_files_read(const std::vector<std::string>& files);

/// Notes nothing: just names them, as they stand on the command line.
std::vector<std::string> files_read(const CLI::App& command);

/// What options say that they write, there or not; streams, devices and pipes are nothing.
std::vector<std::string> files_written(const CLI::App& command);

/// Do two paths, however spelled, name one place? Not where one of them is empty.
bool is_same_place(const std::string& one, const std::string& other);

/// What is written where: option and path; empty paths are not written.
using Outputs = std::vector<std::pair<std::string, std::string>>;

/// Looks at what will be written before any work is done for it. Empty paths are not looked at.
/// Throws: UsageMistake when an output would replace a file that is read, also through links (a
/// slip of the hand must not cost anybody their mesh), or when two outputs are one place, however
/// spelled (a device, as /dev/null, may be named twice); WriteError when an output cannot be
/// written: no folder, a folder's name, no permission. `new_folder`: one that will be made for the
/// outputs in it.
void check_places(const Outputs& outputs, const std::string& new_folder = "");

/// The same for --json alone. Throws: UsageMistake also for the name of a mesh: where --json was a
/// flag once, the word behind it is a mesh, which must not be lost.
void require_report_place(const std::string& json);

/// Files that are read only after work that may take minutes: a slip of the hand is told before.
/// Empty paths and streams are not looked at. Throws: ReadError where one is not there.
void require_there(const std::vector<std::string>& files);

/// Throws: UsageMistake where two files are to come from standard input. `names`: of these files,
/// as in "the mesh and --image".
void require_one_stream(const std::vector<std::string>& inputs, const std::string& names);

/// "statue.sph" of "folder/statue.sph.ply"; a name of its own for standard input.
std::string stem_or(const std::string& path, const std::string& if_stream);

}  // namespace sphparam::cli
