#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "arguments/declaration.h"
#include "console/exit_codes.h"
#include "console/session.h"
#include "sphparam/errors.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/read_options.h"

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
  return {&declaration.app(), [arguments, run] {
            const int code = run(*arguments);
            if constexpr (std::is_base_of_v<CommonArguments, Arguments>)
              return strict_code(*arguments, code);
            return code;
          }};
}

/// Makes assets and adds their files: positions beyond float32 are the input's fault, more than a
/// .glb holds the output's. Throws: UnmeasurableMesh; WriteError; whatever the work throws else.
template <class Work>
void with_file_errors(const std::string& input, const std::string& output, const Work& work) try {
  work();
} catch (const std::range_error& error) {
  throw UnmeasurableMesh(display_name(input) + ": " + error.what());
} catch (const std::length_error& error) {
  throw WriteError(output_name(output), error.what());
}

Command declare_info(CLI::App& program);
Command declare_map(CLI::App& program);
Command declare_asset(CLI::App& program);
Command declare_repair(CLI::App& program);
Command declare_wrap(CLI::App& program);
Command declare_survey(CLI::App& program);
Command declare_verify(CLI::App& program);
Command declare_render(CLI::App& program);
Command declare_compare(CLI::App& program);
Command declare_spharm(CLI::App& program);
Command declare_remesh(CLI::App& program);
Command declare_unimage(CLI::App& program);
Command declare_match(CLI::App& program);
Command declare_group(CLI::App& program);
Command declare_measure(CLI::App& program);
Command declare_paint(CLI::App& program);
Command declare_report(CLI::App& program);
Command declare_export(CLI::App& program);
Command declare_bake(CLI::App& program);
std::vector<Command> declare_batch(CLI::App& program);  // and its own subcommands
Command declare_manual(CLI::App& program);
Command declare_completion(CLI::App& program);

}  // namespace sphparam::cli
