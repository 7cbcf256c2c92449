#pragma once

#include "lanes.h"

namespace sphparam::tests {

/// While it lives, no wider instructions are used than these.
struct InstructionLimit {
  explicit InstructionLimit(InstructionSet widest) { limit_instruction_set(widest); }
  ~InstructionLimit() { limit_instruction_set(InstructionSet::Avx512); }
  InstructionLimit(const InstructionLimit&) = delete;
  InstructionLimit& operator=(const InstructionLimit&) = delete;
};

}  // namespace sphparam::tests
