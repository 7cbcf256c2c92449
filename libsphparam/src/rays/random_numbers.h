#pragma once

#include <cstdint>

namespace sphparam {

/// The bits of a number without its pattern. Source: the finaliser of splitmix64 (Steele, Lea and
/// Flood 2014).
inline std::uint64_t scrambled(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Random bits of a seed and a counter: the same whoever asks, in whatever order.
/// Source: splitmix64, at position `counter`.
inline std::uint64_t random_bits(std::uint64_t seed, std::uint64_t counter) {
  return scrambled(seed + (counter + 1) * 0x9e3779b97f4a7c15u);
}

/// A random number in [0, 1).
inline double random_fraction(std::uint64_t seed, std::uint64_t counter) {
  return static_cast<double>(random_bits(seed, counter) >> 11) * 0x1p-53;
}

}  // namespace sphparam
