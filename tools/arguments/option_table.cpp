#include "arguments/option_table.h"

#include <CLI/CLI.hpp>
#include <cctype>
#include <sstream>

namespace sphparam::cli {

namespace {

OptionEntry entry_of(const CLI::Option& option) {
  OptionEntry entry;
  entry.positional = option.get_positional();
  if (entry.positional) entry.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
  entry.value = option.get_items_expected_max() > 0 ? option.get_type_name() : "";
  if (entry.positional && entry.words().empty()) entry.value.clear();
  entry.description = option.get_description();
  entry.group = option.get_group();
  entry.preset = option.get_default_str();
  entry.required = option.get_required();
  return entry;
}

CommandEntry entry_of(const CLI::App& command) {
  CommandEntry entry{command.get_name(), command.get_description(), {}};
  for (const CLI::Option* option : command.get_options())
    entry.options.push_back(entry_of(*option));
  return entry;
}

}  // namespace

std::vector<std::string> OptionEntry::words() const {
  std::vector<std::string> words;
  if (value.find('|') == std::string::npos) return words;
  std::stringstream parts(value);
  for (std::string part; std::getline(parts, part, '|');) {
    if (!part.empty() && std::islower(static_cast<unsigned char>(part[0]))) words.push_back(part);
  }
  return words;
}

bool OptionEntry::takes_file() const {
  return (positional && value.empty()) || value == "FILE" || value == "IMAGE" || value == "PNG";
}

std::vector<CommandEntry> option_table(const CLI::App& program) {
  std::vector<CommandEntry> table = {entry_of(program)};
  for (const CLI::App* command : program.get_subcommands({})) table.push_back(entry_of(*command));
  return table;
}

}  // namespace sphparam::cli
