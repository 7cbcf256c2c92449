#pragma once

#include <algorithm>
#include <numbers>

#include "sphparam/image/image.h"
#include "sphparam/sphere/spherical_coordinates.h"

namespace sphparam::tests {

/// The equirectangular image of ½ + ½ · direction.
inline sphparam::Image direction_image(int width) {
  sphparam::Image image(width, width / 2, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vector3 direction = to_cartesian(
          {2 * std::numbers::pi * (x + 0.5) / width, std::numbers::pi * (y + 0.5) / image.height});
      for (int c = 0; c < 3; ++c) {
        image.pixel(x, y)[c] = static_cast<float>(0.5 + 0.5 * direction[c]);
      }
    }
  }
  return image;
}

inline sphparam::Image uniform_image(int width, float value) {
  sphparam::Image image(width, width / 2, 3);
  std::fill(image.pixels.begin(), image.pixels.end(), value);
  return image;
}

}  // namespace sphparam::tests
