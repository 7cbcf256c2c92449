#include "srgb_curves.h"

#include "elementary.h"

namespace sphparam {
namespace {

double decoded(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : elementary::pow((srgb + 0.055) / 1.055, 2.4);
}

double encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * elementary::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace

SrgbCurves::SrgbCurves() {
  for (std::uint32_t i = 0; i < steps + 2; ++i) {
    const auto x = static_cast<double>(std::bit_cast<float>((offset + i) << dropped_bits));
    from_srgb_[i] = static_cast<float>(decoded(x));
    from_linear_[i] = static_cast<float>(encoded(x));
  }
}

const SrgbCurves& SrgbCurves::get() {
  static const SrgbCurves curves;
  return curves;
}

}  // namespace sphparam
