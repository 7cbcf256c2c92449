#pragma once

#include <bit>
#include <cstdint>

namespace sphparam {

/// Greedy colouring: the least colour, not below `first` (0 to 63), that none of an item's
/// neighbours has. `for_each_colour(f)` calls f with the colour of every neighbour, a negative one
/// where it has none yet; it is called once for every 64 colours that are taken.
template <class ForEachColour>
int least_free_colour(int first, const ForEachColour& for_each_colour) {
  for (int base = 0;; base += 64) {
    std::uint64_t taken = base == 0 ? (std::uint64_t{1} << first) - 1 : 0;
    for_each_colour([&](int colour) {
      const int c = colour - base;
      if (c >= 0 && c < 64) taken |= std::uint64_t{1} << c;
    });
    if (taken != ~std::uint64_t{0}) return base + std::countr_one(taken);
  }
}

}  // namespace sphparam
