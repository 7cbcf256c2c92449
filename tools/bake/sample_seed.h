#pragma once

#include <cstdint>

namespace sphparam::tools {

/// A number without pattern that depends on nothing but its arguments: of a sample, its texel in
/// the image and its number there.
/// Source: Steele, Lea, Flood, "Fast splittable pseudorandom number generators" (2014).
inline std::uint64_t sample_seed(std::int64_t texel, int sample) {
  std::uint64_t z = static_cast<std::uint64_t>(texel) * 0x9e3779b97f4a7c15 +
                    static_cast<std::uint64_t>(sample) * 0xd1b54a32d192ed03 + 0x2545f4914f6cdd1d;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

}  // namespace sphparam::tools
