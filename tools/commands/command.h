#pragma once

#include <functional>
#include <stdexcept>

#include "console/console.h"

namespace CLI {
class App;
}

namespace sphparam::cli {

/// A subcommand as declared to the command line: `run` does its job with the options parsed, and
/// returns the exit code.
struct Command {
  CLI::App* options;
  std::function<int()> run;
};

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

/// A command line that CLI11 accepts and that makes no sense all the same.
class UsageMistake : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// -q and -v, which every subcommand has.
struct Loudness {
  bool quiet = false;
  bool verbose = false;

  Verbosity verbosity() const {
    return quiet ? Verbosity::Quiet : verbose ? Verbosity::Verbose : Verbosity::Normal;
  }
};

}  // namespace sphparam::cli
