#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "sphparam/progress.h"

namespace sphparam::python {

namespace py = pybind11;

// A call of the library runs in a thread of its own and without Python's lock. The thread that
// Python called from looks around twenty times a second: it shows progress, and hears Ctrl-C,
// however rarely the library reports.

/// What the two threads tell each other.
class CallState {
 public:
  virtual ~CallState() = default;

  /// In the library's thread: does the work.
  void run();

  /// In any thread: the work is to stop.
  void cancel() { cancelled_ = true; }

  /// In Python's thread, with its lock: waits for the end, with `progress` called as
  /// progress(stage, fraction) on the way. Throws: what the work threw; what `progress` threw, or
  /// KeyboardInterrupt, as py::error_already_set.
  /// `leaves`: then without waiting, as nothing but memory is lost.
  static void finish(const std::shared_ptr<CallState>& state, const py::object& progress,
                     bool leaves);

 protected:
  virtual void work(const Progress& progress) = 0;

 private:
  bool note(std::string_view stage, double fraction);
  bool wait_a_little();
  void listen(const py::object& progress);

  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::string stage_;
  double fraction_ = 0;
  bool has_news_ = false;
  std::atomic<bool> cancelled_ = false;
  std::exception_ptr error_;
};

/// Stops calls of other threads and waits for all, those left behind too: Python calls it before
/// it ends.
void end_calls();

/// In a process that was just forked, which has none of these threads.
void forget_calls();

template <class Result>
class Call : public CallState {
 public:
  using Work = std::function<Result(const Progress&)>;
  explicit Call(Work work) : work_(std::move(work)) {}
  Result take() { return std::move(result_.value()); }

 private:
  void work(const Progress& progress) override {
    result_.emplace(work_(progress));
    work_ = nullptr;
  }

  Work work_;
  std::optional<Result> result_;
};

/// The result of `work`, which owns what it works on and touches nothing of Python's.
template <class Work>
auto call(const py::object& progress, Work work) {
  using Result = std::invoke_result_t<Work, const Progress&>;
  const auto state = std::make_shared<Call<Result>>(std::move(work));
  CallState::finish(state, progress, true);
  return state->take();
}

/// The same for work that writes files: after Ctrl-C it is waited for, so that nothing appears
/// later.
template <class Work>
auto writing_call(const py::object& progress, Work work) {
  using Result = std::invoke_result_t<Work, const Progress&>;
  const auto state = std::make_shared<Call<Result>>(std::move(work));
  CallState::finish(state, progress, false);
  return state->take();
}

}  // namespace sphparam::python
