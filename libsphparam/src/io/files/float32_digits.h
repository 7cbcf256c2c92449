#pragma once

#include <string_view>

namespace sphparam {

/// Whether a decimal number says more than the float32 nearest to it: that one, written with as
/// many digits, would be another text. All that programs print of numbers of 32 bits says no more.
/// `value`: the double that `text` is. What is less than the least normal float32 is not counted.
bool exceeds_float32(std::string_view text, double value);

/// The float32 nearest to `value`.
inline double rounded_to_float32(double value) {
  return static_cast<double>(static_cast<float>(value));
}

}  // namespace sphparam
