#pragma once

#include <algorithm>
#include <cmath>

#include "sphparam/texture/texture_options.h"

namespace sphparam {

/// The texel that stands at i, where an image goes on beyond its ends.
inline int wrapped(int i, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) return std::clamp(i, 0, size - 1);
  const int period = wrap == TextureWrap::Mirror ? 2 * size : size;
  i %= period;
  if (i < 0) i += period;
  return i < size ? i : period - 1 - i;
}

/// A coordinate such that it and its neighbours in a run make small numbers, the same on the image.
inline double near_zero(double x, TextureWrap wrap) {
  if (wrap == TextureWrap::Repeat) return x - std::floor(x);
  if (wrap == TextureWrap::Mirror) return x - 2 * std::floor(x / 2);
  return x;
}

}  // namespace sphparam
