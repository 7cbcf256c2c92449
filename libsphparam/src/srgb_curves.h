#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sphparam {

/// The transfer curves of sRGB (IEC 61966-2-1) for whole images: by tables, some nanoseconds a
/// value. Values are clamped to [0, 1]; NaN becomes 0. Relative error below 1e-5, at the
/// joint of line and curve; elsewhere 1e-6.
class SrgbCurves {
 public:
  float to_linear(float srgb) const { return look_up(from_srgb_, srgb); }
  float to_srgb(float linear) const { return look_up(from_linear_, linear); }

  static const SrgbCurves& get();

 private:
  SrgbCurves();

  // A table over the leading bits of a float: 2^10 steps an octave, from 2^-10 to 1. Below that,
  // both curves are lines.
  static constexpr int dropped_bits = 23 - 10;
  static constexpr float least = 0x1p-10F;
  static constexpr std::uint32_t offset = std::bit_cast<std::uint32_t>(least) >> dropped_bits;
  static constexpr size_t steps = 10 << 10;
  using Table = std::array<float, steps + 2>;

  static float look_up(const Table& table, float x) {
    if (!(x > least)) return x > 0 ? x * (table[0] / least) : 0;
    if (x >= 1) return 1;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t step = bits >> dropped_bits;
    const auto rest = static_cast<float>(bits & ((1U << dropped_bits) - 1)) * 0x1p-13F;
    const float low = table[step - offset], high = table[step - offset + 1];
    return low + rest * (high - low);
  }

  Table from_srgb_, from_linear_;
};

}  // namespace sphparam
