#include "call.h"

#include <chrono>
#include <set>
#include <vector>

#include "sphparam/stopped_by.h"

namespace sphparam::python {
namespace {

constexpr auto between_looks = std::chrono::milliseconds(50);

/// How long Python waits, as it ends, for a callback of a thread to come back: it may wait for what
/// never comes.
constexpr auto longest_callback = std::chrono::seconds(3);

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

LeftCalls*& left_calls() {
  static auto* calls = new LeftCalls;
  return calls;
}

/// Calls that threads of Python wait for. One that Python ends by force, as it does with daemon
/// threads that come back for its lock when it has ended, takes the whole process with it.
class OpenCalls {
 public:
  /// Throws Cancelled where Python ends, and not in this thread.
  void begin(CallState& call) {
    const std::lock_guard lock(mutex_);
    if (ending_ && *ending_ != std::this_thread::get_id()) throw Cancelled();
    calls_.insert(&call);
  }
  void end(CallState& call) {
    const std::lock_guard lock(mutex_);
    calls_.erase(&call);
    changed_.notify_all();
  }
  void begin_callback(CallState& call) {
    const std::lock_guard lock(mutex_);
    in_callback_.insert(&call);
  }
  void end_callback(CallState& call) {
    const std::lock_guard lock(mutex_);
    in_callback_.erase(&call);
  }
  /// Stops them, and those that would follow, and waits until the last one is over, or no more are
  /// left than callbacks that do not come back.
  void stop() {
    std::unique_lock lock(mutex_);
    ending_ = std::this_thread::get_id();
    for (CallState* const call : calls_) call->cancel();
    const auto enough = std::chrono::steady_clock::now() + longest_callback;
    const auto is_over = [&] {
      return calls_.empty() ||
             (calls_ == in_callback_ && std::chrono::steady_clock::now() > enough);
    };
    while (!is_over()) changed_.wait_for(lock, between_looks);
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<CallState*> calls_, in_callback_;
  std::optional<std::thread::id> ending_;
};

OpenCalls*& open_calls() {
  static auto* calls = new OpenCalls;
  return calls;
}

/// One of them, as long as this lives.
class OpenCall {
 public:
  explicit OpenCall(CallState& call) : call_(call) { open_calls()->begin(call); }
  ~OpenCall() { open_calls()->end(call_); }
  OpenCall(const OpenCall&) = delete;
  OpenCall& operator=(const OpenCall&) = delete;

 private:
  CallState& call_;
};

/// It is in its callback, as long as this lives.
class OpenCallback {
 public:
  explicit OpenCallback(CallState& call) : call_(call) { open_calls()->begin_callback(call); }
  ~OpenCallback() { open_calls()->end_callback(call_); }
  OpenCallback(const OpenCallback&) = delete;
  OpenCallback& operator=(const OpenCallback&) = delete;

 private:
  CallState& call_;
};

/// False, of NumPy's comparisons too; None goes on.
bool says_no(const py::object& answer) {
  py::detail::make_caster<bool> truth;
  return truth.load(answer, false) && !static_cast<bool>(truth);
}

}  // namespace

void end_calls() {
  const py::gil_scoped_release unlocked;
  open_calls()->stop();
  left_calls()->wait();
}

void forget_calls() {
  left_calls() = new LeftCalls;
  open_calls() = new OpenCalls;
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
  const OpenCallback open(*this);
  if (says_no(progress(stage, fraction))) cancel();
}

void CallState::finish(const std::shared_ptr<CallState>& state, const py::object& progress,
                       bool leaves) {
  const OpenCall open(*state);
  std::thread thread([state] { state->run(); });
  try {
    while (!state->wait_a_little()) state->listen(progress);
    state->listen(progress);
  } catch (...) {
    state->cancel();
    if (leaves) {
      left_calls()->add(std::move(thread));
    } else {
      const py::gil_scoped_release unlocked;
      thread.join();
    }
    throw;
  }
  thread.join();
  if (state->error_) std::rethrow_exception(state->error_);
  // The work may have made its last report before the answer to an earlier one was there.
  if (state->cancelled_) throw Cancelled();
}

}  // namespace sphparam::python
