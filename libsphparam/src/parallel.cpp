#include "sphparam/parallel.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "most_threads.h"
#include "sphparam/errors.h"
#include "sphparam/stopped_by.h"

// One pool for the process: the caller works too and waits only for chunks that somebody claimed. A
// loop inside a loop runs on its own thread, so nothing can wait for itself; so does one that comes
// while another caller's has the pool, which may take long. Sweeps are thousands
// of loops of some microseconds each: whoever waits looks around for a while before it sleeps.
// Each worker begins with a range of its own, the same in all loops alike: what it wrote in the
// last one is in its cache, and fetching lines from another core's costs more than most bodies.

namespace sphparam {
namespace {

constexpr int looks = 1000;  // before a thread sleeps: some ten microseconds

/// What ends the loops of this thread, if anything.
const std::atomic<bool>*& stop_of_thread() {
  thread_local const std::atomic<bool>* stop = nullptr;
  return stop;
}

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

/// Waits a little for something that is about to happen.
template <class Happened>
void look_out_for(const Happened& happened) {
  for (int i = 0; i < looks && !happened(); ++i) pause();
}

/// Chunks that nobody has claimed yet. Its owner takes the first of them, helpers the last.
class alignas(64) Range {
 public:
  void set(std::int64_t first, std::int64_t end) {
    ends_.store(pack(static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(end)),
                std::memory_order_relaxed);
  }

  /// −1: none is left.
  std::int64_t claim(bool as_owner) {
    std::uint64_t ends = ends_.load(std::memory_order_relaxed);
    for (;;) {
      const std::uint64_t first = ends & 0xffffffff, end = ends >> 32;
      if (first == end) return -1;
      const std::uint64_t rest = as_owner ? pack(first + 1, end) : pack(first, end - 1);
      if (ends_.compare_exchange_weak(ends, rest, std::memory_order_relaxed)) {
        return static_cast<std::int64_t>(as_owner ? first : end - 1);
      }
    }
  }

 private:
  static std::uint64_t pack(std::uint64_t first, std::uint64_t end) { return first | end << 32; }

  std::atomic<std::uint64_t> ends_{0};
};

constexpr int most_ranges = 16;                   // more workers share them
constexpr std::int64_t most_chunks = 0xffffffff;  // of a loop

using Body = std::function<void(std::int64_t, std::int64_t)>;

class Loop {
 public:
  Loop(std::int64_t count, std::int64_t grain, const Body& body)
      : count_(count), grain_(grain), chunks_((count + grain - 1) / grain), body_(body) {}

  std::int64_t chunks() const { return chunks_; }

  /// Gives every worker a range, if there are not too many.
  void split(int workers) {
    parts_ = std::min(workers, most_ranges);
    for (int i = 0; i < parts_; ++i) {
      ranges_[i].set(chunks_ * i / parts_, chunks_ * (i + 1) / parts_);
    }
  }

  /// A worker's own range, then what is left of the others'.
  void work(int worker) {
    const auto* const before = std::exchange(stop_of_thread(), stop_);  // of loops inside this one
    bool goes_on = true;
    for (int i = 0; i < parts_; ++i) {
      Range& range = ranges_[(worker + i) % parts_];
      for (std::int64_t chunk; goes_on && (chunk = range.claim(i == 0)) >= 0;) goes_on = run(chunk);
    }
    stop_of_thread() = before;
  }

  void work_alone() {
    for (std::int64_t chunk = 0; chunk < chunks_ && run(chunk);) ++chunk;
  }

  /// Of the first chunk that threw: the same for any timing.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  /// False: the loop was stopped, and that is its error.
  bool run(std::int64_t chunk) {
    const bool is_stopped = stop_ && *stop_;
    try {
      if (is_stopped) throw Cancelled();
      body_(chunk * grain_, std::min(count_, (chunk + 1) * grain_));
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_ || chunk < error_chunk_) {
        error_ = std::current_exception();
        error_chunk_ = chunk;
      }
    }
    return !is_stopped;
  }

  const std::int64_t count_, grain_, chunks_;
  const Body& body_;
  const std::atomic<bool>* const stop_ = stop_of_thread();
  int parts_ = 0;
  Range ranges_[most_ranges];
  std::mutex mutex_;
  std::exception_ptr error_;
  std::int64_t error_chunk_ = 0;
};

class Pool {
 public:
  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
    }
    wake_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }

  /// False: another loop has it, nothing was done.
  bool run(Loop& loop, int helpers) {
    std::unique_lock one_loop_at_a_time(loop_mutex_, std::defer_lock);
    look_out_for([&] { return one_loop_at_a_time.try_lock(); });
    if (!one_loop_at_a_time.owns_lock()) return false;
    {
      const std::lock_guard lock(mutex_);
      while (static_cast<int>(workers_.size()) < helpers) {
        try {
          const int worker = static_cast<int>(workers_.size()) + 1;
          workers_.emplace_back([this, worker] { serve(worker); });
        } catch (const std::system_error&) {
          break;  // the system grants no more threads: fewer do the same work
        } catch (const std::bad_alloc&) {
          break;
        }
      }
      loop_ = &loop;
      places_ = helpers;
      if (asleep_ > 0) wake_.notify_all();
    }
    loop.work(0);
    {
      const std::lock_guard lock(mutex_);
      loop_ = nullptr;
      places_ = 0;
    }
    look_out_for([this] { return busy_ == 0; });
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return busy_ == 0; });
    return true;
  }

 private:
  void serve(int worker) {
    inside_pool() = true;
    const auto called = [this] { return quit_ || places_ > 0; };
    for (;;) {
      look_out_for(called);
      std::unique_lock lock(mutex_);
      ++asleep_;
      wake_.wait(lock, called);
      --asleep_;
      if (quit_) return;
      --places_;
      ++busy_;
      Loop* loop = loop_;
      lock.unlock();
      loop->work(worker);
      lock.lock();
      if (--busy_ == 0) idle_.notify_all();
    }
  }

  std::mutex loop_mutex_;
  std::mutex mutex_;
  std::condition_variable wake_, idle_;
  std::vector<std::thread> workers_;
  Loop* loop_ = nullptr;
  // Changed under the mutex; atomic, so that who looks out for them need not hold it.
  std::atomic<int> places_ = 0;  // how many more workers may join the loop
  std::atomic<int> busy_ = 0;
  std::atomic<bool> quit_ = false;
  int asleep_ = 0;

 public:
  static bool& inside_pool() {
    thread_local bool inside = false;
    return inside;
  }
};

/// The pool of this process. One that was forked has none of its parent's threads, and their locks
/// lie as they happened to be held: it leaves that pool alone for ever, and makes its own.
class PoolOfProcess {
 public:
  PoolOfProcess() { ::pthread_atfork(nullptr, nullptr, leave_to_parent); }
  ~PoolOfProcess() { delete pool_; }

  static Pool& get() {
    Pool* found = pool_;
    if (!found) {
      auto made = std::make_unique<Pool>();
      if (pool_.compare_exchange_strong(found, made.get())) found = made.release();
    }
    return *found;
  }

 private:
  static void leave_to_parent() {
    if (Pool* const pool = pool_.exchange(nullptr)) left_ = pool;
  }

  static inline std::atomic<Pool*> pool_ = nullptr;
  static inline Pool* left_ = nullptr;  // so that nobody who looks for leaks calls it lost
};

const PoolOfProcess ends_with_process;

}  // namespace

StoppedBy::StoppedBy(const std::atomic<bool>& stop)
    : before_(std::exchange(stop_of_thread(), &stop)) {}

StoppedBy::~StoppedBy() { stop_of_thread() = before_; }

namespace {
std::atomic<int> most_threads = 0;
}

void keep_to_threads(int most) { most_threads = most; }

int resolve_threads(int threads) {
  // Asked once: the answer comes from a file, and a map has thousands of loops.
  static const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (threads > 0) return threads;
  const int most = most_threads;
  return most > 0 ? std::min(most, cores) : cores;
}

void parallel_for(std::int64_t count, std::int64_t grain, int threads,
                  const std::function<void(std::int64_t, std::int64_t)>& body) {
  if (count <= 0) return;
  Loop loop(count, std::max<std::int64_t>(grain, 1), body);
  const int helpers =
      static_cast<int>(std::min<std::int64_t>(loop.chunks(), resolve_threads(threads)) - 1);
  if (helpers <= 0 || loop.chunks() > most_chunks || Pool::inside_pool()) {
    loop.work_alone();
  } else {
    loop.split(helpers + 1);
    Pool& pool = PoolOfProcess::get();
    Pool::inside_pool() = true;
    const bool done = pool.run(loop, helpers);
    Pool::inside_pool() = false;
    if (!done) loop.work_alone();
  }
  loop.rethrow();
}

double parallel_sum(std::int64_t count, int threads,
                    const std::function<double(std::int64_t, std::int64_t)>& chunk_sum) {
  constexpr std::int64_t grain = 4096;
  std::vector<double> partial(static_cast<size_t>((count + grain - 1) / grain), 0.0);
  parallel_for(count, grain, threads, [&](std::int64_t first, std::int64_t last) {
    partial[static_cast<size_t>(first / grain)] = chunk_sum(first, last);
  });
  double sum = 0;
  for (const double value : partial) sum += value;
  return sum;
}

}  // namespace sphparam
