#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

/// Running a program under limits, for tests that expect it to misbehave.
namespace sphparam::tests {

struct ProcessLimits {
  double seconds = 60;           // then it is killed
  std::uint64_t memory = 0;      // bytes of address space; 0: no limit
  std::uint64_t file_bytes = 0;  // of any file it writes; 0: no limit
};

struct ProcessSignal {
  int number = 0;    // 0: none
  double after = 0;  // seconds from the start
};

struct ProcessEnd {
  int code = -1;           // exit code; 128 + N when signal N ended it
  bool timed_out = false;  // it was killed after `seconds`
  std::string messages;    // standard error and standard output, the first 64 KiB
};

/// Runs argv[0] (a path) with an empty standard input; `environment` ("NAME=value") comes on top of
/// this process's. Safe to call on several threads.
ProcessEnd run_process(const std::vector<std::string>& argv,
                       const std::vector<std::string>& environment = {},
                       const ProcessLimits& limits = {}, const ProcessSignal& signal = {});

}  // namespace sphparam::tests
