#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sphparam::campaign {

struct RunLimits {
  double seconds = 30;               // of processor time; ten times that of wall time
  std::uint64_t bytes = 2ull << 30;  // of memory: heap and stacks
};

struct RunEnd {
  int code = 0;             // exit code; 128 + N where signal N ended it
  double seconds = 0;       // of processor time
  std::uint64_t bytes = 0;  // of memory, at most
  std::string messages;     // standard error, the first 2000 bytes
};

/// Runs the program in a child of this process, which has all its code: a run costs a fork and its
/// own work. Standard output goes nowhere. Requires: no other thread of this process is at work.
/// Throws: std::runtime_error, if the system has no more processes or files.
RunEnd run_in_child(const std::string& folder, const std::vector<std::string>& words,
                    const RunLimits& limits);

}  // namespace sphparam::campaign
