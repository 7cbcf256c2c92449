#pragma once

#include <cstdint>

#include "rays/random_numbers.h"

namespace sphparam {

/// A number without pattern that depends on nothing but its arguments: of a sample, its texel in
/// the image and its number there.
inline std::uint64_t sample_seed(std::int64_t texel, int sample) {
  return scrambled(static_cast<std::uint64_t>(texel) * 0x9e3779b97f4a7c15 +
                   static_cast<std::uint64_t>(sample) * 0xd1b54a32d192ed03 + 0x2545f4914f6cdd1d);
}

}  // namespace sphparam
