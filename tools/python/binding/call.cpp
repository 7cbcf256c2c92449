#include "call.h"

#include <chrono>
#include <vector>

#include "sphparam/stopped_by.h"

namespace sphparam::python {
namespace {

constexpr auto between_looks = std::chrono::milliseconds(50);

/// Threads of calls that were left by Ctrl-C. They end at their next report of progress, or the
/// next piece of a loop.
class LeftCalls {
 public:
  void add(std::thread thread) {
    const std::lock_guard lock(mutex_);
    threads_.push_back(std::move(thread));
  }
  void wait() {
    const std::lock_guard lock(mutex_);
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
  }

 private:
  std::mutex mutex_;
  std::vector<std::thread> threads_;
};

LeftCalls& left_calls() {
  static LeftCalls calls;
  return calls;
}

}  // namespace

void wait_for_left_calls() {
  const py::gil_scoped_release unlocked;
  left_calls().wait();
}

bool CallState::note(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  if (stage != stage_) stage_ = stage;
  fraction_ = fraction;
  has_news_ = true;
  return !cancelled_;
}

void CallState::run() {
  const StoppedBy stop(cancelled_);
  try {
    work([this](std::string_view stage, double fraction) { return note(stage, fraction); });
  } catch (...) {
    error_ = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  done_ = true;
  ended_.notify_one();
}

/// Whether the work is done.
bool CallState::wait_a_little() {
  const py::gil_scoped_release unlocked;
  std::unique_lock lock(mutex_);
  return ended_.wait_for(lock, between_looks, [this] { return done_; });
}

/// Throws py::error_already_set where the user wants no more of it.
void CallState::listen(const py::object& progress) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (progress.is_none()) return;
  std::string stage;
  double fraction = 0;
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(has_news_, false)) return;
    stage = stage_, fraction = fraction_;
  }
  if (progress(stage, fraction).is(py::bool_(false))) cancelled_ = true;
}

void CallState::finish(const std::shared_ptr<CallState>& state, const py::object& progress,
                       bool leaves) {
  std::thread thread([state] { state->run(); });
  try {
    while (!state->wait_a_little()) state->listen(progress);
    state->listen(progress);
  } catch (...) {
    state->cancelled_ = true;
    if (leaves) {
      left_calls().add(std::move(thread));
    } else {
      const py::gil_scoped_release unlocked;
      thread.join();
    }
    throw;
  }
  thread.join();
  if (state->error_) std::rethrow_exception(state->error_);
}

}  // namespace sphparam::python
