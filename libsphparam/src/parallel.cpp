#include "sphparam/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

// One pool for the process: the caller works too and waits only for chunks that somebody claimed. A
// loop inside a loop runs on its own thread, so nothing can wait for itself. Sweeps are thousands
// of loops of some microseconds each: whoever waits looks around for a while before it sleeps.

namespace sphparam {
namespace {

constexpr int looks = 1000;  // before a thread sleeps: some ten microseconds

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

struct Loop {
  std::int64_t count;
  std::int64_t grain;
  std::int64_t chunks;
  const std::function<void(std::int64_t, std::int64_t)>* body;
  std::atomic<std::int64_t> next_chunk{0};
  std::mutex mutex;
  std::exception_ptr error;  // of the first chunk that threw: the same for any timing
  std::int64_t error_chunk;

  void work() {
    for (;;) {
      const std::int64_t chunk = next_chunk.fetch_add(1, std::memory_order_relaxed);
      if (chunk >= chunks) return;
      try {
        (*body)(chunk * grain, std::min(count, (chunk + 1) * grain));
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error || chunk < error_chunk) {
          error = std::current_exception();
          error_chunk = chunk;
        }
      }
    }
  }
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

  void run(Loop& loop, int helpers) {
    const std::lock_guard one_loop_at_a_time(loop_mutex_);
    {
      const std::lock_guard lock(mutex_);
      while (static_cast<int>(workers_.size()) < helpers) {
        try {
          workers_.emplace_back([this] { serve(); });
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
    loop.work();
    {
      const std::lock_guard lock(mutex_);
      loop_ = nullptr;
      places_ = 0;
    }
    look_out_for([this] { return busy_ == 0; });
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return busy_ == 0; });
  }

 private:
  void serve() {
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
      loop->work();
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

Pool& pool() {
  static Pool instance;
  return instance;
}

}  // namespace

int resolve_threads(int threads) {
  if (threads > 0) return threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(std::int64_t count, std::int64_t grain, int threads,
                  const std::function<void(std::int64_t, std::int64_t)>& body) {
  if (count <= 0) return;
  grain = std::max<std::int64_t>(grain, 1);
  Loop loop{count, grain, (count + grain - 1) / grain, &body, {}, {}, {}, {}};
  const int helpers =
      static_cast<int>(std::min<std::int64_t>(loop.chunks, resolve_threads(threads)) - 1);
  if (helpers <= 0 || Pool::inside_pool()) {
    loop.work();
  } else {
    Pool::inside_pool() = true;
    pool().run(loop, helpers);
    Pool::inside_pool() = false;
  }
  if (loop.error) std::rethrow_exception(loop.error);
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
