#pragma once

#include <sys/types.h>

#include <functional>

namespace sphparam {

/// A process forked from this one that runs `work`, ends with the code that it returns, and is
/// killed when its parent is no more. Nothing of the parent's is cleaned up in it.
/// Requires: no other thread. Throws: BatchMachineError where there can be none.
pid_t start_child(const std::function<int()>& work);

struct ChildEnd {
  int code = 0;  // 128 + N where signal N ended it
  double cpu_seconds = 0;
};

/// Waits for one that ends.
ChildEnd wait_for_child(pid_t child);

}  // namespace sphparam
