// `sphparam batch run`: a plan, or a task of it, on the cores of this machine.

#include "arguments/numbers.h"
#include "commands/batch.h"
#include "console/interruption.h"
#include "number_text.h"
#include "sphparam/batch/run.h"

namespace sphparam::cli {

namespace {

constexpr char run_help[] =
    "Run a planned batch, or a task of it: what is done is skipped.\n"
    "\n"
    "Examples:\n"
    "  sphparam batch run work/                 all of it, on all cores\n"
    "  sphparam batch run work/ --task 17 --threads 4\n"
    "  sphparam batch run work/ --max-memory 2G   of each item\n"
    "\n"
    "Any number of runs may go on at once, on any machines that share the folder. Killed at any\n"
    "moment, the next run goes on. An item that failed is not tried again for the same input,\n"
    "options and program until `batch retry` says so. Ends with 0 also where items failed, with\n"
    "--strict with the code of the first that did; with 3 where the machine fails.\n";

struct RunArguments : CommonArguments {
  std::string folder, plan;
  std::optional<int> task;
  bool strict = false, rehash = false, any_program = false;
};

void tell(const BatchRunSummary& summary, Console& console) {
  const auto count = [](std::size_t number) { return std::to_string(number); };
  std::string line = counted(static_cast<long>(summary.items), "item") + ": " +
                     count(summary.done) + " done, " + count(summary.failed) + " failed, " +
                     count(summary.skipped) + " done before";
  if (summary.skipped_failed > 0) line += ", " + count(summary.skipped_failed) + " failed before";
  if (summary.done_elsewhere > 0)
    line += ", " + count(summary.done_elsewhere) + " done by another run meanwhile";
  console.say(line + "; " + short_number(summary.seconds) + " s, " +
              short_number(summary.item_cpu_seconds) + " s of CPU in items, " +
              short_number(summary.own_cpu_seconds) + " s beside them");
  if (summary.other_program > 0)
    console.warning(count(summary.other_program) +
                    " were done by another build of sphparam, and again now; --any-program takes "
                    "them as they are");
  if (summary.failed + summary.skipped_failed > 0)
    console.say("  `sphparam batch status` says why items failed");
}

int exit_code(const BatchRunSummary& summary, bool strict) {
  if (summary.interrupted) return Interrupted;
  if (!strict || summary.first_failure == 0) return Ok;
  return summary.first_failure > 128 ? InternalError : summary.first_failure;
}

int run_run(RunArguments& arguments) try {
  Session session(arguments);
  const BatchPlan plan = load_plan(arguments.folder, arguments.plan);
  session.hold_signals();
  BatchRunOptions options{.run_step =
                              [](const BatchStep& words, const BatchStepSetting& step) {
                                return run_batch_step(words, step.report, step.threads);
                              },
                          .task = arguments.task.value_or(0),
                          .workers = arguments.threads,
                          .rehash = arguments.rehash,
                          .any_program = arguments.any_program};
  options.progress = [&](std::size_t ended, std::size_t all) {
    const double share = all == 0 ? 1 : static_cast<double>(ended) / static_cast<double>(all);
    return session.console.progress("items", share,
                                    ", " + std::to_string(ended) + " of " + std::to_string(all));
  };
  const BatchRunSummary summary = run_batch(arguments.folder, plan, options);
  session.console.clear_progress();
  tell(summary, session.console);
  if (summary.interrupted) print_error("interrupted");
  return exit_code(summary, arguments.strict);
} catch (const BatchInputError& error) {
  throw UsageMistake(error.what());
} catch (const BatchMachineError& error) {
  print_error(error.what());
  return FileError;
}

void declare_options(Declaration& command, RunArguments& arguments) {
  command.input("FOLDER", arguments.folder, "The batch")
      .text("--plan", arguments.plan, "NAME", "Another plan than the latest")
      .number("--task", arguments.task, "N", {1}, "This task of it only")
      .flag("--strict", arguments.strict, "End with the exit code of the first item that failed")
      .flag("--rehash", arguments.rehash,
            "Read all inputs again, also those whose size and times are as they were")
      .flag("--any-program", arguments.any_program,
            "What another build of sphparam made counts as done")
      .number("--threads", arguments.threads, "N", {0, 4096},
              "How many items at once (0: all cores); same bytes")
      .console(arguments);
}

}  // namespace

Command declare_batch_run(CLI::App& program) {
  return make_command(program, "run", run_help, declare_options, run_run);
}

}  // namespace sphparam::cli
