#include "console/files_read.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "commands/command.h"
#include "console/paths.h"
#include "sphparam/io/safe_file.h"

namespace sphparam::cli {

namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

/// The options of each subcommand that name what is written.
const std::map<std::string, Names> writing_options = {
    {"bake", {"--output", "--json"}},
    {"compare", {"--output"}},
    {"export", {"--output", "--json"}},
    {"info", {"--json"}},
    {"map", {"--output", "--write-sphere", "--json", "--charts"}},
    {"measure", {"--per-vertex", "--json"}},
    {"paint", {"--output"}},
    {"remesh",
     {"--output", "--geometry-image", "--normals", "--attribute-image", "--limit-mesh",
      "--displace", "--rebuild", "--csv", "--json"}},
    {"render", {"--output"}},
    {"report", {"--output", "--json"}},
    {"spharm", {"--json", "--csv", "--reconstruct"}},
    {"unimage", {"--output"}},
    {"verify", {"--json"}},
};

Names& files_read() {
  static Names files;
  return files;
}

/// The words that may name a file: all of it, and what follows a sign that joins it to a name.
Names file_words(const std::string& text) {
  Names words = {text};
  for (size_t at = text.find_first_of("=:"); at != std::string::npos;
       at = text.find_first_of("=:", at + 1))
    words.push_back(text.substr(at + 1));
  return words;
}

bool is_file(const std::string& path) {
  std::error_code hidden;
  return !path.empty() && !is_stream(path) && fs::is_regular_file(path, hidden);
}

bool writes(const CLI::App& command, const CLI::Option& option) {
  const auto names = writing_options.find(command.get_name());
  if (names == writing_options.end()) return false;
  return std::any_of(names->second.begin(), names->second.end(),
                     [&](const std::string& name) { return option.check_name(name); });
}

Names files_named(const CLI::Option& option) {
  Names files;
  for (const std::string& text : option.results()) {
    for (const std::string& word : file_words(text))
      if (is_file(word)) files.push_back(word);
  }
  return files;
}

}  // namespace

void note_files_read(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (writes(command, *option)) continue;
    for (std::string& file : files_named(*option)) files_read().push_back(std::move(file));
  }
  keep_from_outputs(files_read());
  for (const CLI::Option* option : command.get_options()) {
    if (!writes(command, *option)) continue;
    for (const std::string& file : files_named(*option)) require_not_read(option->get_name(), file);
  }
}

void require_not_read(const std::string& option, const std::string& output) {
  if (!is_file(output)) return;
  for (const std::string& input : files_read()) {
    std::error_code missing;  // a file that is not there is no other file
    if (fs::equivalent(input, output, missing))
      throw UsageMistake(option + ": " + output + " is the input; it would be replaced");
  }
}

}  // namespace sphparam::cli
