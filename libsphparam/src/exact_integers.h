#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace sphparam {

// Doubles as integers, whose sums and products nothing rounds: for signs that a filter leaves open.

using BigInteger = boost::multiprecision::cpp_int;

struct ScaledInteger {
  std::int64_t mantissa;
  int exponent;
};

/// x = mantissa·2^exponent, from its bits: arithmetic may take a subnormal x for zero.
/// Requires: finite.
inline ScaledInteger scaled_integer(double x) {
  constexpr std::uint64_t one = std::uint64_t{1} << 52;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto biased = static_cast<int>(bits >> 52 & 0x7ff);
  const auto size = static_cast<std::int64_t>((bits & (one - 1)) | (biased > 0 ? one : 0));
  return {bits >> 63 ? -size : size, std::max(biased, 1) - 1075};
}

/// Numbers times one power of two, which makes integers of them: a sign of sums of products of as
/// many factors each does not change. Requires: finite.
template <std::size_t count>
std::array<BigInteger, count> as_integers(const std::array<double, count>& numbers) {
  std::array<ScaledInteger, count> scaled;
  int lowest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < count; ++i) {
    scaled[i] = scaled_integer(numbers[i]);
    if (scaled[i].mantissa != 0) lowest = std::min(lowest, scaled[i].exponent);
  }
  std::array<BigInteger, count> result;
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = scaled[i].mantissa;
    if (scaled[i].mantissa != 0) result[i] <<= scaled[i].exponent - lowest;
  }
  return result;
}

inline BigInteger determinant(const std::array<BigInteger, 3>& a,
                              const std::array<BigInteger, 3>& b,
                              const std::array<BigInteger, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

}  // namespace sphparam
