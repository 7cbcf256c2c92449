#include "cli/common_options.h"

#include <CLI/CLI.hpp>

#include "cli/choice.h"

namespace sphparam::tools {

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "How many threads (0: all cores); same bytes")
      ->check(between(0, 4096, "0 to 4096"))
      ->type_name("N")
      ->capture_default_str();
}

void add_progress(CLI::App& command, ProgressStyle& progress) {
  add_choice<ProgressStyle>(
      command, "--progress", progress,
      {{"auto", ProgressStyle::Auto}, {"none", ProgressStyle::None}, {"json", ProgressStyle::Json}},
      "How far it is; auto: on a terminal (default: auto)");
}

void add_loudness(CLI::App& command, Loudness& loudness) {
  command.add_flag("-q,--quiet", loudness.quiet, "Errors only");
  command.add_flag("-v,--verbose", loudness.verbose, "Every stage");
}

}  // namespace sphparam::tools
