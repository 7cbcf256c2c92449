#pragma once

#include <atomic>

namespace sphparam {

/// While it lives, loops of this thread (`parallel_for`), and loops inside them, look at `stop`
/// before each of their chunks, and end with Cancelled once it is true. So work can be left that
/// reports no progress, or rarely; who takes any exception for a defect of its input must let
/// Cancelled pass. Of two that live in one thread the later one holds.
///
/// Requires: `stop` outlives it; it ends in the thread that it began in.
class StoppedBy {
 public:
  explicit StoppedBy(const std::atomic<bool>& stop);
  ~StoppedBy();
  StoppedBy(const StoppedBy&) = delete;
  StoppedBy& operator=(const StoppedBy&) = delete;

 private:
  const std::atomic<bool>* before_;
};

}  // namespace sphparam
