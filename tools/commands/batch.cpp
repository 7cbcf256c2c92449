// `sphparam batch`: thousands of shapes. What it does is in the library; here are its words.

#include "commands/batch.h"

#include <CLI/CLI.hpp>

namespace sphparam::cli {

namespace {

constexpr char summary[] =
    "Map shapes by the thousand, on this machine, with Slurm or with Snakemake.\n"
    "\n"
    "Examples:\n"
    "  sphparam batch plan subjects.txt -o work/ -- map --repair\n"
    "  sbatch work/array.sbatch        # or: snakemake -s work/Snakefile -j 16\n"
    "                                  # or: sphparam batch run work/\n"
    "  sphparam batch status work/\n"
    "  sphparam batch retry work/ --code 1\n"
    "  sphparam batch report work/ -o all.html\n"
    "\n"
    "Each has its own --help: sphparam batch plan --help.\n";

}  // namespace

std::vector<Command> declare_batch(CLI::App& program) {
  CLI::App& batch = *program.add_subcommand("batch", summary);
  batch.require_subcommand(1);
  std::vector<Command> commands;
  for (const auto declare : {declare_batch_plan, declare_batch_run, declare_batch_status,
                             declare_batch_retry, declare_batch_table, declare_batch_report})
    commands.push_back(declare(batch));
  return commands;
}

}  // namespace sphparam::cli
