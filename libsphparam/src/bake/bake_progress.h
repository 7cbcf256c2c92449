#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>

#include "sphparam/progress.h"

namespace sphparam {

/// How far a bake is, told by whichever thread comes along, one at a time and some times a second,
/// so that work that takes minutes between two rows of texels is shown, and can be cancelled.
class BakeProgress {
 public:
  /// `samples` is what there is to do. Outlived by the callback.
  BakeProgress(const Progress& progress, std::int64_t samples)
      : progress_(progress), samples_(samples) {}

  void add(std::int64_t samples) { done_.fetch_add(samples, std::memory_order_relaxed); }

  /// Throws: Cancelled, on every thread once the callback has said so to one.
  /// Cost: some 10 ns, between reports.
  void look() {
    if (cancelled_.load(std::memory_order_relaxed)) throw Cancelled();
    const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
    if (!progress_ || now < next_.load(std::memory_order_relaxed)) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return;
    next_ = now + std::chrono::steady_clock::duration(interval).count();
    const double done = static_cast<double>(done_.load(std::memory_order_relaxed));
    if (progress_("bake", done / static_cast<double>(samples_))) return;
    cancelled_ = true;
    throw Cancelled();
  }

 private:
  static constexpr std::chrono::milliseconds interval{200};

  const Progress& progress_;
  std::int64_t samples_;
  std::atomic<std::int64_t> done_ = 0, next_ = 0;
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
};

}  // namespace sphparam
