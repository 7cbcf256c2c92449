// One table of options, three languages. Bash: a case by subcommand and by the word before the
// cursor. Zsh: one _arguments a subcommand. Fish: one `complete` an option.

#include "console/completion.h"

#include "number_text.h"

namespace sphparam::cli {

namespace {

/// Backslashes before these letters.
std::string escaped(const std::string& text, const std::string& letters) {
  std::string safe;
  for (const char c : text) {
    if (letters.find(c) != std::string::npos) safe += '\\';
    safe += c;
  }
  return safe;
}

/// Inside single quotes, for all three shells.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + safe + "'";
}

std::string flags_of(const CommandEntry& command) {
  std::vector<std::string> names;
  for (const OptionEntry& option : command.options) {
    if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return joined(names, " ");
}

/// Is it a subcommand of a subcommand?
bool is_nested(const CommandEntry& command) { return command.name.find(' ') != std::string::npos; }

std::vector<std::string> command_names(const std::vector<CommandEntry>& table) {
  std::vector<std::string> names;
  for (size_t i = 1; i < table.size(); ++i)
    if (!is_nested(table[i])) names.push_back(table[i].name);
  return names;
}

/// Those that have subcommands, in the words of a shell: "batch".
std::string groups(const std::vector<CommandEntry>& table, const std::string& between) {
  std::vector<std::string> names;
  for (size_t i = 1; i + 1 < table.size(); ++i)
    if (!is_nested(table[i]) && is_nested(table[i + 1])) names.push_back(table[i].name);
  return joined(names, between);
}

/// The words that the positional arguments of a command may be; empty: files.
std::vector<std::string> positional_words(const CommandEntry& command) {
  for (const OptionEntry& option : command.options) {
    if (option.positional && !option.words().empty()) return option.words();
  }
  return {};
}

std::string bash_values(const CommandEntry& command) {
  std::string cases;
  for (const OptionEntry& option : command.options) {
    if (option.positional || option.value.empty()) continue;
    const std::vector<std::string> words = option.words();
    const std::string reply =
        !words.empty() ? "COMPREPLY=($(compgen -W " + quoted(joined(words, " ")) + " -- \"$word\"))"
        : option.takes_folder()
            ? "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- \"$word\")"
        : option.takes_file()
            ? "compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$word\")"
            : "COMPREPLY=()";
    cases += "        " + joined(option.names, "|") + ") " + reply + "; return ;;\n";
  }
  return cases;
}

std::string bash_script(const std::vector<CommandEntry>& table) {
  std::string script =
      "# bash completion of sphparam\n"
      "_sphparam() {\n"
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\" before=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
      "  local options=" +
      quoted(flags_of(table.front())) + " rest=" + quoted(joined(command_names(table), " ")) +
      "\n"
      "  local at=1\n"
      "  while [[ $at -lt $COMP_CWORD && ${COMP_WORDS[at]} == -* ]]; do\n"
      "    case ${COMP_WORDS[at]} in --progress|--threads|--max-memory|--limit) ((at++)) ;; esac\n"
      "    ((at++))\n"
      "  done\n"
      "  local command=\"${COMP_WORDS[at]}\"\n"
      "  [[ $COMP_CWORD -gt $((at + 1)) ]] && case $command in " +
      groups(table, "|") +
      ") command+=\" ${COMP_WORDS[at+1]}\" ;; esac\n"
      "  [[ $COMP_CWORD -gt $at ]] && case $command in\n";
  for (size_t i = 1; i < table.size(); ++i) {
    script += "    '" + table[i].name + "')\n      options=" + quoted(flags_of(table[i])) +
              " rest=" + quoted(joined(positional_words(table[i]), " ")) + "\n";
    const std::string values = bash_values(table[i]);
    if (!values.empty()) script += "      case \"$before\" in\n" + values + "      esac\n";
    script += "      ;;\n";
  }
  return script +
         "  esac\n"
         "  if [[ $word == -?* ]]; then COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
         "  elif [[ $rest ]]; then COMPREPLY=($(compgen -W \"$rest\" -- \"$word\"))\n"
         "  else compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
         "  fi\n"
         "}\n"
         "complete -F _sphparam sphparam\n";
}

/// ":FILE:_files": what stands for an argument in the language of _arguments.
std::string zsh_argument(const std::string& message, const OptionEntry& option) {
  const std::vector<std::string> words = option.words();
  if (!words.empty()) return ":" + message + ":(" + joined(words, " ") + ")";
  if (option.takes_folder()) return ":" + message + ":_files -/";
  return ":" + message + (option.takes_file() ? ":_files" : ": ");
}

std::string zsh_arguments(const CommandEntry& command) {
  std::string lines;
  const auto add = [&](const std::string& spec) { lines += " \\\n        " + quoted(spec); };
  for (const OptionEntry& option : command.options) {
    if (option.positional) {
      add(zsh_argument(option.names.front(), option));
      continue;
    }
    for (const std::string& name : option.names) {  // each excludes the others
      std::string spec = "(";
      spec += joined(option.names, " ") + ")" + name;
      spec.append("[").append(escaped(option.description, "[]:")).append("]");
      if (!option.value.empty()) spec += zsh_argument("value", option);
      add(spec);
    }
  }
  return lines;
}

std::string zsh_script(const std::vector<CommandEntry>& table) {
  std::string script =
      "#compdef sphparam\n"
      "_sphparam() {\n"
      "  local -a commands=(\n";
  for (size_t i = 1; i < table.size(); ++i) {
    if (is_nested(table[i])) continue;
    script += "    " + quoted(table[i].name + ":" + escaped(table[i].headline(), ":")) + "\n";
  }
  script +=
      "  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe command commands\n"
      "    _arguments -s" +
      zsh_arguments(table.front()) +
      "\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words; (( CURRENT-- ))\n"
      "  case $command in " +
      groups(table, "|") +
      ") (( CURRENT > 2 )) && { command+=\" $words[2]\"; shift words; (( CURRENT-- )); } ;; "
      "esac\n"
      "  case $command in\n";
  for (size_t i = 1; i < table.size(); ++i) {
    script +=
        "    '" + table[i].name + "')\n      _arguments -s" + zsh_arguments(table[i]) + " ;;\n";
  }
  return script +
         "  esac\n"
         "}\n"
         "if [[ $funcstack[1] == _sphparam ]]; then _sphparam \"$@\"; else compdef _sphparam "
         "sphparam; "
         "fi\n";
}

std::string fish_option(const OptionEntry& option) {
  std::string line;
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  const std::vector<std::string> words = option.words();
  if (!words.empty()) {
    line += " -x -a " + quoted(joined(words, " "));
  } else if (option.takes_folder()) {
    line += " -x -a '(__fish_complete_directories)'";
  } else if (!option.value.empty()) {
    line += option.takes_file() ? " -r -F" : " -x";
  }
  return line + " -d " + quoted(option.description);
}

std::string fish_script(const std::vector<CommandEntry>& table) {
  std::string script =
      "# fish completion of sphparam\n"
      "complete -c sphparam -n __fish_use_subcommand -f\n";
  const std::string line = "complete -c sphparam -n ";
  for (const OptionEntry& option : table.front().options) {
    script += line + "__fish_use_subcommand" + fish_option(option) + "\n";
  }
  for (size_t i = 1; i < table.size(); ++i) {
    const CommandEntry& command = table[i];
    const std::string name = command.name.substr(command.name.find(' ') + 1);
    const std::string group =
        is_nested(command) ? command.name.substr(0, command.name.find(' ')) : "";
    const std::string in_group =
        group.empty() ? "" : "__fish_seen_subcommand_from " + group + "; and ";
    script +=
        line +
        (group.empty() ? "__fish_use_subcommand" : quoted("__fish_seen_subcommand_from " + group)) +
        " -a " + name + " -d " + quoted(command.headline()) + "\n";
    const std::string here = line + quoted(in_group + "__fish_seen_subcommand_from " + name);
    for (const OptionEntry& option : command.options) {
      if (!option.positional) script += here + fish_option(option) + "\n";
    }
    const std::vector<std::string> words = positional_words(command);
    if (!words.empty()) script += here + " -f -a " + quoted(joined(words, " ")) + "\n";
  }
  return script;
}

}  // namespace

std::string completion_script(Shell shell, const std::vector<CommandEntry>& table) {
  switch (shell) {
    case Shell::Bash:
      return bash_script(table);
    case Shell::Zsh:
      return zsh_script(table);
    case Shell::Fish:
      return fish_script(table);
  }
  return "";
}

}  // namespace sphparam::cli
