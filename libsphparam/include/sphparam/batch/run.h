#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/batch/plan.h"

namespace sphparam {

/// The machine, not a mesh: no space, no permission. What is settled stays so.
class BatchMachineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a step ends with where the machine has no room for what it writes: that is no failure of
/// its mesh, and the run ends.
inline constexpr int step_has_no_room = 75;  // EX_TEMPFAIL of sysexits.h

/// What a step gets beside its words, where they do not say it.
struct BatchStepSetting {
  std::string report;  // where what --json tells is to go
  int threads = 1;
};

struct BatchRunOptions {
  /// Runs one step in the current folder, in a process of its own; returns its exit code, as
  /// `sphparam` has them, or `step_has_no_room`. What it says on standard error and output becomes
  /// the item's log.
  std::function<int(const BatchStep&, const BatchStepSetting&)> run_step = {};
  int task = 0;              // from 1; 0: all
  int workers = 0;           // items at once; 0: one a core
  bool rehash = false;       // read all inputs again, whatever their times say
  bool any_program = false;  // what another build of the program made counts too
  /// Which items, instead of a task: numbers in the plan.
  std::vector<std::size_t> only = {};
  /// How many items have ended, of how many; also asked in between. False ends the run in good
  /// order.
  std::function<bool(std::size_t ended, std::size_t all)> progress = {};
};

/// What a run found and did.
struct BatchRunSummary {
  std::size_t items = 0;
  std::size_t skipped = 0;         // done before: same input, options and program
  std::size_t skipped_failed = 0;  // failed before, for the same
  std::size_t done = 0;
  std::size_t failed = 0;
  std::size_t done_elsewhere = 0;  // another run was faster; ours was thrown away
  std::size_t other_program = 0;   // made again since another build of the program made it
  bool interrupted = false;
  int first_failure = 0;  // the exit code of the first item in the plan's order that failed now or
                          // before; 128 + N where signal N ended it; 0: none
  double seconds = 0;
  double item_cpu_seconds = 0;  // of the items' processes
  double own_cpu_seconds = 0;   // of this one
};

/// Runs a plan, or a task of it, in the folder of its batch.
///
/// An item is a process forked from this one, a step a process forked from that: what crashes,
/// runs out of memory or is killed is that item's failure and nobody else's. An item works in a
/// folder of its own below `staging`, which is renamed to `results/ID` as a whole when all steps
/// ended with 0: its files and record.json, or nothing. A failure is `failed/ID.json`.
/// Skipped is an item whose record is there, agrees in the hashes of input, options and program,
/// and whose files are there; and one that failed for the same, until `retry_batch`. An input is
/// read again for that unless size, times and number of the file are those noted in the record.
///
/// Any number of runs of one batch may go on at once, on any machines that share the folder: there
/// are no locks, the first that renames wins. Whatever is killed at whatever moment, the next run
/// takes it up; what is left below `staging` by processes of this machine that are no more is
/// removed. The results are the same bytes for any number of workers, tasks and runs.
///
/// Requires: no other thread in this process. Throws: BatchMachineError; ReadError;
/// BatchInputError for a task that is not there; std::invalid_argument for such a number in `only`.
/// Cost: two forks and a rename an item, some milliseconds.
BatchRunSummary run_batch(const std::string& folder, const BatchPlan& plan,
                          const BatchRunOptions& options);

}  // namespace sphparam
