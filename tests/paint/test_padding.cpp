#include <algorithm>
#include <catch2/catch.hpp>

#include "paint/padding.h"

using namespace sphparam;

namespace {

Image image_of(int width, int height, float value) {
  Image image(width, height, 1);
  std::fill(image.pixels.begin(), image.pixels.end(), value);
  return image;
}

}  // namespace

TEST_CASE("pad: rings grow by one texel in all eight directions and take the colour inside") {
  Image image = image_of(11, 11, 0);
  std::vector<std::uint8_t> painted(121, 0);
  image.pixel(5, 5)[0] = 3;
  painted[5 * 11 + 5] = 1;
  pad(image, painted, 2);
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 11; ++x) {
      const int ring = std::max(std::abs(x - 5), std::abs(y - 5));
      CHECK(painted[static_cast<size_t>(y * 11 + x)] == (ring <= 2 ? ring + 1 : 0));
      CHECK(image.pixel(x, y)[0] == 3);  // beyond the rings: the mean of what was painted
    }
  }
}

TEST_CASE("pad: a border between two colours goes on outwards") {
  Image image = image_of(8, 8, 0);
  std::vector<std::uint8_t> painted(64, 0);
  for (int y = 3; y < 5; ++y) {
    for (int x = 0; x < 8; ++x) {
      image.pixel(x, y)[0] = x < 4 ? 0.0F : 1.0F;
      painted[static_cast<size_t>(y * 8 + x)] = 1;
    }
  }
  pad(image, painted, 1);
  CHECK(image.pixel(1, 2)[0] == 0);
  CHECK(image.pixel(6, 5)[0] == 1);
  CHECK(image.pixel(3, 2)[0] == Approx(1.0 / 3));
  CHECK(image.pixel(0, 0)[0] == 0.5F);
}

TEST_CASE("pad: nothing painted, all painted, and no rings are left alone") {
  Image image = image_of(4, 4, 0.5F);
  std::vector<std::uint8_t> none(16, 0), all(16, 1);
  pad(image, none, 5);
  pad(image, all, 5);
  CHECK(std::count(image.pixels.begin(), image.pixels.end(), 0.5F) == 16);
  CHECK(std::count(all.begin(), all.end(), 1) == 16);
}
