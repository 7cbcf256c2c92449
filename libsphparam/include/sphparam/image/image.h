#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sphparam {

/// An image in memory: rows from the top, interleaved channels, floats. Colour images hold sRGB
/// values in [0, 1] unless said otherwise.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> pixels;  // width·height·channels

  Image() = default;
  Image(int w, int h, int c)
      : width(w), height(h), channels(c), pixels(static_cast<size_t>(w) * h * c) {}
  float* pixel(int x, int y) { return &pixels[(static_cast<size_t>(y) * width + x) * channels]; }
  const float* pixel(int x, int y) const {
    return &pixels[(static_cast<size_t>(y) * width + x) * channels];
  }
};

}  // namespace sphparam
