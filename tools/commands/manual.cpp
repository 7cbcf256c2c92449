// `sphparam manual` and `sphparam completion`: the program explains itself to `man` and to shells.

#include "console/manual.h"

#include "commands/command.h"
#include "console/completion.h"
#include "sphparam/io/safe_file.h"

namespace sphparam::cli {

namespace {

constexpr char manual_summary[] =
    "Print the manual page, as roff.\n"
    "\n"
    "Examples:\n"
    "  sphparam manual | man -l -\n";

constexpr char completion_summary[] =
    "Print what teaches a shell to complete sphparam's commands and options.\n"
    "\n"
    "Examples:\n"
    "  source <(sphparam completion bash)             in ~/.bashrc; zsh likewise\n"
    "  sphparam completion fish | source              in ~/.config/fish/config.fish\n";

}  // namespace

Command declare_manual(CLI::App& program) {
  return {&Declaration(program, "manual", manual_summary).app(), [&program] {
            write_file("-", manual_page(option_table(program)));
            return Ok;
          }};
}

Command declare_completion(CLI::App& program) {
  const auto shell = std::make_shared<Shell>(Shell::Bash);
  Declaration command(program, "completion", completion_summary);
  command
      .choice("SHELL", *shell, {{"bash", Shell::Bash}, {"zsh", Shell::Zsh}, {"fish", Shell::Fish}},
              "The shell that is to learn it")
      .required();
  return {&command.app(), [&program, shell] {
            write_file("-", completion_script(*shell, option_table(program)));
            return Ok;
          }};
}

}  // namespace sphparam::cli
