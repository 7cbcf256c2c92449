#pragma once

#include <algorithm>
#include <limits>

namespace sphparam {

/// The integer that stands for a value from 0 to 1: beyond them it is clamped, what is no number
/// becomes 0.
template <class Sample>
Sample integer_sample(double value) {
  constexpr double full = std::numeric_limits<Sample>::max();
  return value > 0 ? static_cast<Sample>(std::min(value, 1.0) * full + 0.5) : Sample{0};
}

}  // namespace sphparam
