#pragma once

#include <cstdio>
#include <cstdlib>

namespace sphparam::tests {

/// Ends the program where a law is broken, so that the fuzzer keeps the input.
inline void expect(bool holds, const char* law) {
  if (holds) return;
  std::fprintf(stderr, "broken law: %s\n", law);
  std::abort();
}

}  // namespace sphparam::tests
