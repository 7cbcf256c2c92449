#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "console/console.h"
#include "console/interruption.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/progress.h"
#include "sphparam/stopwatch.h"

namespace sphparam::cli {

/// What (nearly) every subcommand is told.
struct CommonArguments {
  std::string json;  // where the report goes; empty: nowhere
  int threads = 0;   // 0: all cores
  ProgressStyle progress = ProgressStyle::Auto;
  bool quiet = false, verbose = false;
  bool strict = false;  // what is warned of, or lost, is a failure
  /// Warnings and losses that sessions of these arguments have told, once they are over.
  mutable std::size_t complaints = 0;
};

/// The exit code of a run that ended with `code`: LimitExceeded, which is told, where it is Ok, and
/// what is told is to be a failure.
int strict_code(const CommonArguments& arguments, int code);

/// One run of a subcommand: what it tells, how far it is, and its outputs, which appear all or
/// none.
class Session {
 public:
  explicit Session(const CommonArguments& arguments);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  Console console;
  const Stopwatch stopwatch;

  int threads() const { return arguments_.threads; }
  /// From here on a signal only asks the work to stop, as there may be files to clean up.
  void hold_signals() {
    if (!orderly_) orderly_.emplace();
  }
  /// For the library: shown, and false once a signal arrived.
  Progress progress();
  void warn(const std::vector<std::string>& warnings);
  /// What --json asks for, if it does; what was told is added to it, up to `publish`, where it is
  /// written.
  void add_report(const std::function<std::string()>& report);
  /// From here on signals are held. Throws: Cancelled where one has arrived; as
  /// `PendingFiles::publish`.
  void publish();

 private:
  const CommonArguments& arguments_;
  std::optional<OrderlyInterruption> orderly_;
  std::optional<std::string> report_;

 public:
  PendingFiles files;  // they are cleaned up before signals are let go
};

}  // namespace sphparam::cli
