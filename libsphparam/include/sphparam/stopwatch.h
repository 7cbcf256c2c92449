#pragma once

#include <chrono>
#include <utility>

namespace sphparam {

/// Wall time in seconds.
class Stopwatch {
 public:
  /// Since it was made.
  double seconds() const { return between(start_, Clock::now()); }

  /// Since the last lap, or since it was made.
  double lap() {
    const auto now = Clock::now();
    return between(std::exchange(last_, now), now);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double between(Clock::time_point first, Clock::time_point last) {
    return std::chrono::duration<double>(last - first).count();
  }

  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace sphparam
