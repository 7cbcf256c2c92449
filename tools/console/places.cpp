#include "console/places.h"

#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "console/exit_codes.h"
#include "sphparam/io/companions.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/safe_file.h"

namespace sphparam::cli {

namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

/// With its name: a batch parses one command line after the other, and an option may lie in memory
/// where another one of an earlier line lay.
using MarkedOption = std::pair<const CLI::Option*, std::string>;

MarkedOption marked(const CLI::Option& option) { return {&option, option.get_name()}; }

std::set<MarkedOption>& options_that_write() {
  static std::set<MarkedOption> options;
  return options;
}

bool writes(const CLI::Option& option) { return options_that_write().contains(marked(option)); }

Names& noted_files() {
  static Names files;
  return files;
}

/// The words that may name a file: all of it, what follows a sign that joins it to a name, and what
/// stands between commas.
Names file_words(const std::string& text) {
  Names words = {text};
  for (size_t at = text.find_first_of("=:"); at != std::string::npos;
       at = text.find_first_of("=:", at + 1))
    words.push_back(text.substr(at + 1));
  const Names joined = words;
  for (const std::string& word : joined) {
    if (word.find(',') == std::string::npos) continue;
    for (size_t from = 0; from <= word.size();) {
      const size_t comma = std::min(word.find(',', from), word.size());
      words.push_back(word.substr(from, comma - from));
      from = comma + 1;
    }
  }
  return words;
}

bool is_file(const std::string& path) {
  std::error_code hidden;
  return !path.empty() && !is_stream(path) && fs::is_regular_file(path, hidden);
}

Names files_named(const CLI::Option& option) {
  Names files;
  for (const std::string& text : option.results()) {
    for (const std::string& word : file_words(text))
      if (is_file(word)) files.push_back(word);
  }
  return files;
}

/// What tells a file from others, whatever it is called.
using FileId = std::pair<dev_t, ino_t>;

std::set<FileId> ids_of(const Names& files) {
  std::set<FileId> ids;
  for (const std::string& file : files) {
    struct stat status {};  // a file that is not there is no other file
    if (::stat(file.c_str(), &status) == 0) ids.emplace(status.st_dev, status.st_ino);
  }
  return ids;
}

/// `output` may be a device, or not there.
void require_not_read(const std::string& option, const std::string& output,
                      const std::set<FileId>& read) {
  if (!is_file(output)) return;
  for (const FileId& id : ids_of({output}))
    if (read.contains(id))
      throw UsageMistake(option + ": " + output + " is the input; it would be replaced");
}

std::string file_name(const std::string& path) { return fs::path(path).filename().string(); }

/// Devices and pipes take what two outputs have to say.
bool holds_one_output(const std::string& path) {
  std::error_code hidden;
  const fs::file_status status = fs::status(path, hidden);
  return is_stream(path) || !fs::exists(status) || fs::is_regular_file(status) ||
         fs::is_directory(status);
}

/// What a path names, however it is spelled; a stream as it is.
std::string place_of(const std::string& path) {
  if (is_stream(path)) return path;
  std::error_code hidden;
  const fs::path absolute = fs::absolute(path, hidden);
  const fs::path canonical = fs::weakly_canonical(absolute, hidden);
  return (hidden ? absolute.lexically_normal() : canonical).string();  // a name may be too long
}

void require_distinct(const Outputs& outputs) {
  std::map<std::string, std::string> option_at;  // by place: a group has thousands
  for (const auto& [option, path] : outputs) {
    if (path.empty() || !holds_one_output(path)) continue;
    const auto [found, is_new] = option_at.emplace(place_of(path), option);
    if (is_new) continue;
    const std::string& other = found->second;
    throw UsageMistake((other == option ? option + " twice: " : other + " and " + option + ": ") +
                       "the same file, " + output_name(path));
  }
}

}  // namespace

void mark_written(const CLI::Option& option) { options_that_write().insert(marked(option)); }

std::vector<std::string> files_read(const CLI::App& command) {
  Names files;
  for (const CLI::Option* option : command.get_options()) {
    if (writes(*option)) continue;
    for (std::string& file : files_named(*option)) files.push_back(std::move(file));
  }
  return files;
}

std::vector<std::string> files_written(const CLI::App& command) {
  Names files;
  for (const CLI::Option* option : command.get_options()) {
    if (!writes(*option)) continue;
    for (const std::string& path : option->results())
      if (!is_stream(path) && holds_one_output(path)) files.push_back(path);
  }
  return files;
}

void note_files_read(const CLI::App& command) {
  for (std::string& file : files_read(command)) noted_files().push_back(std::move(file));
  keep_from_outputs(noted_files());
  guard_companions();
  const std::set<FileId> read = ids_of(noted_files());
  for (const CLI::Option* option : command.get_options()) {
    if (!writes(*option)) continue;
    for (const std::string& file : files_named(*option))
      require_not_read(option->get_name(), file, read);
  }
}

void note_files_read(const std::vector<std::string>& files) {
  noted_files().insert(noted_files().end(), files.begin(), files.end());
  keep_from_outputs(files);
}

bool is_same_place(const std::string& one, const std::string& other) {
  return !one.empty() && !other.empty() && place_of(one) == place_of(other);
}

void check_places(const Outputs& outputs, const std::string& new_folder) {
  const std::set<FileId> read = ids_of(noted_files());
  for (const auto& [option, path] : outputs) require_not_read(option, path, read);
  require_distinct(outputs);
  for (const auto& [option, path] : outputs) {
    const fs::path in_new = fs::path(new_folder) / file_name(path);
    const bool is_there = new_folder.empty() || !is_same_place(path, in_new.string());
    if (!path.empty() && is_there) require_writable(path);
  }
}

void require_report_place(const std::string& json) {
  check_places({{"--json", json}});
  if (is_mesh_name(json)) {
    throw UsageMistake("--json: " + json +
                       " is the name of a mesh, not of a report; `--json -` is standard output");
  }
}

void require_there(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    std::error_code hidden;
    if (file.empty() || is_stream(file) ||
        fs::status(file, hidden).type() != fs::file_type::not_found)
      continue;
    throw ReadError(file, std::make_error_code(std::errc::no_such_file_or_directory).message());
  }
}

void require_one_stream(const std::vector<std::string>& inputs, const std::string& names) {
  if (std::ranges::count_if(inputs, is_stream) > 1)
    throw UsageMistake(names + " cannot both come from standard input");
}

std::string stem_or(const std::string& path, const std::string& if_stream) {
  return is_stream(path) ? if_stream : fs::path(path).stem().string();
}

}  // namespace sphparam::cli
