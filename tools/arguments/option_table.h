#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sphparam::cli {

/// An option or a positional argument, as the command line declares it.
struct OptionEntry {
  std::vector<std::string> names;  // "-o", "--output"; "MESH" for a positional one
  std::string value;               // "FILE", "N", "auto|none|V1,V2"; empty for a flag
  std::string description;
  std::string group;
  std::string preset;  // its value where none is given; empty: none, or told in the description
  bool required = false;
  bool positional = false;

  /// What may be typed as the value, letter by letter: "auto" and "none" of "auto|none|V1,V2".
  std::vector<std::string> words() const;
  bool takes_file() const;  // "FILE", "FILE,…", "FILE.csv", "PAGE.html", "IMAGE", "PNG"
  bool takes_folder() const { return value == "FOLDER"; }
};

struct CommandEntry {
  std::string name;  // "batch plan" of a subcommand's subcommand
  std::string text;  // of --help: a line, examples, remarks
  std::vector<OptionEntry> options;

  std::string headline() const { return text.substr(0, text.find('\n')); }
};

/// The program as data, for its manual and its completions: the options of the program itself come
/// first, under its own name, then the subcommands, those of subcommands behind theirs.
std::vector<CommandEntry> option_table(const CLI::App& program);

}  // namespace sphparam::cli
