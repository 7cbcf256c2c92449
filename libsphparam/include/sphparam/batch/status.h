#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sphparam/batch/plan.h"

namespace sphparam {

/// Failures that are alike: the same exit code, step and, but for names and numbers, the same
/// message.
struct BatchFailures {
  int code = 0;      // 128 + N: signal N
  std::string step;  // "4 measure", the same for all; empty: it was none of the steps
  /// With the step before it, where there are several: "step 4, measure: …". Of several failures
  /// that are not equal with NAME for a shape's name and numbers that differ from the least to the
  /// greatest.
  std::string reason;
  std::size_t count = 0;
  std::vector<std::string> ids;  // the first ten
};

struct BatchStatus {
  std::string plan;
  std::size_t items = 0;
  std::size_t done = 0, failed = 0;
  std::size_t certified = 0;    // of the done: a map is proved one-to-one
  std::size_t repaired = 0;     // of the done: their meshes were mended
  std::size_t wrapped = 0;      // of the done: `asset` drew a surface about them instead
  std::size_t warned = 0;       // of the done: a step warned of something
  std::size_t to_retry = 0;     // of the failed: to be tried again
  std::size_t marked_open = 0;  // tasks that Snakemake has for done, of which an item is open
  std::size_t running = 0;  // folders below `staging` whose processes live, or may live elsewhere
  std::vector<BatchFailures> failures = {};  // most first
  double cpu_seconds_an_item = 0;            // of what is settled, the mean; 0: nothing is
  double cpu_seconds_left = 0;               // of what is not settled, by size of input
  std::optional<double> seconds_left = {};   // at the pace of the last items that ended; nothing:
                                             // none ended lately
  std::size_t open() const { return items - done - failed; }  // never tried to the end
};

/// How far a batch is, from its files alone: no input is read, no scheduler asked.
/// Items whose record is not whole are open. Throws: ReadError for one that may not be read. Cost:
/// reads the record of each item, 20 µs each.
BatchStatus batch_status(const std::string& folder, const BatchPlan& plan, int threads = 0);

/// "17 s", "25 min", "3.1 h", "12 days".
std::string duration(double seconds);

/// Several lines for people; as JSON.
std::string to_text(const BatchStatus& status);
std::string to_json(const BatchStatus& status);

/// Which failures are to be tried again; all where nothing is said.
struct BatchRetryOptions {
  std::vector<int> codes = {};
  std::vector<std::string> ids = {};
};

struct BatchRetry {
  std::size_t items = 0;
  std::vector<int> tasks;  // that have them, ascending
};

/// Marks failures, so that the next run tries them again. Attempts go on being counted.
/// Throws: BatchInputError for an id that did not fail; ReadError; WriteError.
BatchRetry retry_batch(const std::string& folder, const BatchPlan& plan,
                       const BatchRetryOptions& options = {});

/// "1-3,7" of 1, 2, 3, 7: as `sbatch --array` takes them.
std::string ranges_of(const std::vector<int>& numbers);

}  // namespace sphparam
