#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "image/image_codec.h"
#include "image/webp.h"

using namespace sphparam;

namespace {

/// Smooth colours with some noise; alpha, where there is one, in steps, 0 among them.
Image picture(int width, int height, int channels) {
  Image image(width, height, channels);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> noise(0, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        const bool alpha = channels % 2 == 0 && c == channels - 1;
        const double wave = 120 + 100 * std::sin(0.05 * x * (c + 1)) * std::cos(0.04 * y);
        const int value = alpha ? 85 * (x / 16 % 4) : static_cast<int>(wave) + noise(random);
        image.pixel(x, y)[c] = static_cast<float>(value) / 255;
      }
    }
  }
  return image;
}

/// The largest difference of colours, in steps of 8 bits, and of alpha.
std::pair<double, double> differences(const Image& a, const Image& b) {
  double colour = 0, alpha = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      for (int c = 0; c < a.channels; ++c) {
        const double off =
            255 * std::abs(static_cast<double>(a.pixel(x, y)[c]) - static_cast<double>(b.pixel(x, y)[c]));
        (c == 3 ? alpha : colour) = std::max(c == 3 ? alpha : colour, off);
      }
    }
  }
  return {colour, alpha};
}

}  // namespace

TEST_CASE("webp: without loss all samples come back, beneath what is transparent too") {
  for (const int channels : {3, 4}) {
    const Image image = picture(96, 48, channels);
    const Image read = decode_image(encode_webp(image), "w");
    REQUIRE(read.channels == channels);
    const auto [colour, alpha] = differences(image, read);
    CHECK(colour < 0.01);
    CHECK(alpha < 0.01);
  }
}

TEST_CASE("webp: with loss colours are near and alpha is the same; less quality is smaller") {
  for (const int channels : {3, 4}) {
    const Image image = picture(192, 96, channels);
    const std::vector<char> fine = encode_webp(image, {.lossless = false, .quality = 95}),
                            coarse = encode_webp(image, {.lossless = false, .quality = 40});
    CHECK(coarse.size() < fine.size());
    CHECK(fine.size() < encode_webp(image).size());
    const auto [colour, alpha] = differences(image, decode_image(fine, "w"));
    CHECK(colour > 0.5);
    CHECK(colour < 40);
    CHECK(alpha < 0.01);
  }
}

TEST_CASE("webp: grey becomes RGB, values beyond [0, 1] are clamped, bytes are the same again") {
  Image grey = picture(32, 16, 1), both = picture(32, 16, 2);
  grey.pixels[0] = -1;
  grey.pixels[1] = 7;
  const Image read = decode_image(encode_webp(grey), "w");
  REQUIRE(read.channels == 3);
  CHECK(read.pixels[0] == 0);
  CHECK(read.pixels[3] == 1);
  CHECK(*read.pixel(9, 9) == grey.pixels[9 * 32 + 9]);
  CHECK(decode_image(encode_webp(both), "w").channels == 4);
  CHECK(encode_webp(both) == encode_webp(both));
}

TEST_CASE("webp: an image that is too large is refused") {
  CHECK_THROWS_AS(encode_webp(Image(most_webp_side + 1, 1, 3)), ImageError);
  CHECK(encode_webp(Image(most_webp_side, 1, 3)).size() > 0);
}
