#pragma once

#include "commands/command.h"

namespace sphparam::cli {

// The subcommands of `batch`; `program` is `sphparam batch`.
Command declare_batch_plan(CLI::App& program);
Command declare_batch_run(CLI::App& program);
Command declare_batch_status(CLI::App& program);
Command declare_batch_retry(CLI::App& program);
Command declare_batch_table(CLI::App& program);
Command declare_batch_report(CLI::App& program);

/// A step of a batch as the program runs it, in a process of its own.
int run_batch_step(const std::vector<std::string>& words, const std::string& report, int threads);

}  // namespace sphparam::cli
