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

CommandEntry entry_of(const CLI::App& command, const std::string& name) {
  CommandEntry entry{name, command.get_description(), {}};
  for (const CLI::Option* option : command.get_options())
    entry.options.push_back(entry_of(*option));
  return entry;
}

/// What stands for the subcommands that a subcommand has.
OptionEntry choice_of_subcommands(const std::vector<const CLI::App*>& subcommands) {
  OptionEntry choice;
  choice.names = {"SUBCOMMAND"};
  choice.description = "Each with options of its own";
  for (const CLI::App* command : subcommands)
    choice.value += (choice.value.empty() ? "" : "|") + command->get_name();
  choice.required = choice.positional = true;
  return choice;
}

void add_entries(const CLI::App& command, const std::string& name,
                 std::vector<CommandEntry>& table) {
  table.push_back(entry_of(command, name));
  const std::vector<const CLI::App*> subcommands = command.get_subcommands({});
  if (subcommands.empty()) return;
  table.back().options.push_back(choice_of_subcommands(subcommands));
  for (const CLI::App* subcommand : subcommands)
    add_entries(*subcommand, name + " " + subcommand->get_name(), table);
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
  return (positional && value.empty()) || value.starts_with("FILE") || value.starts_with("PAGE.") ||
         value == "IMAGE" || value == "PNG";
}

std::vector<CommandEntry> option_table(const CLI::App& program) {
  std::vector<CommandEntry> table = {entry_of(program, program.get_name())};
  for (const CLI::App* command : program.get_subcommands({}))
    add_entries(*command, command->get_name(), table);
  return table;
}

}  // namespace sphparam::cli
