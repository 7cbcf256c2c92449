#pragma once

#include <functional>
#include <memory>
#include <string>

#include "arguments/declaration.h"
#include "console/exit_codes.h"

namespace sphparam::cli {

/// A subcommand as declared to the command line: `run` does its job with the options parsed, and
/// returns the exit code.
struct Command {
  CLI::App* options;
  std::function<int()> run;
};

/// The one that these functions declare and run; the arguments live as long as it does.
template <class Arguments>
Command make_command(CLI::App& program, const std::string& name, const std::string& summary,
                     void (*declare)(Declaration&, Arguments&), int (*run)(Arguments&)) {
  const auto arguments = std::make_shared<Arguments>();
  Declaration declaration(program, name, summary);
  declare(declaration, *arguments);
  return {&declaration.app(), [arguments, run] { return run(*arguments); }};
}

Command declare_info(CLI::App& program);
Command declare_map(CLI::App& program);
Command declare_verify(CLI::App& program);
Command declare_render(CLI::App& program);
Command declare_compare(CLI::App& program);
Command declare_spharm(CLI::App& program);
Command declare_remesh(CLI::App& program);
Command declare_unimage(CLI::App& program);
Command declare_measure(CLI::App& program);
Command declare_paint(CLI::App& program);
Command declare_report(CLI::App& program);
Command declare_export(CLI::App& program);
Command declare_bake(CLI::App& program);
Command declare_manual(CLI::App& program);
Command declare_completion(CLI::App& program);

}  // namespace sphparam::cli
