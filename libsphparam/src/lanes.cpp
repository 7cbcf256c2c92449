#include "lanes.h"

#include <algorithm>
#include <atomic>

namespace sphparam {
namespace {

InstructionSet widest_of_machine() {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw")) {
    return InstructionSet::Avx512;
  }
  if (__builtin_cpu_supports("avx2")) return InstructionSet::Avx2;
#endif
  return InstructionSet::Baseline;
}

std::atomic<InstructionSet>& chosen() {
  static std::atomic<InstructionSet> set = widest_of_machine();
  return set;
}

}  // namespace

InstructionSet instruction_set() { return chosen().load(std::memory_order_relaxed); }

void limit_instruction_set(InstructionSet widest) {
  chosen() = std::min(widest, widest_of_machine());
}

}  // namespace sphparam
