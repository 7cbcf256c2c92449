#include <algorithm>
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

Image by_png(const Image& image) {
  return decode_image(encode_image(image, ImageFormat::Png), "p");
}

/// The largest difference of some channels, in steps of 8 bits.
double difference(const Image& a, const Image& b, int first, int last) {
  double most = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = first; c < last; ++c)
        most = std::max(most, 255.0 * std::abs(a.pixel(x, y)[c] - b.pixel(x, y)[c]));
  return most;
}

}  // namespace

TEST_CASE("webp: without loss every number is what a PNG gives, beneath what is transparent too") {
  for (const int channels : {3, 4}) {
    const Image image = picture(96, 48, channels);
    const Image read = decode_image(encode_webp(image), "w");
    REQUIRE(read.channels == channels);
    CHECK((read.pixels == by_png(image).pixels));
  }
}

TEST_CASE("webp: with loss colours are near and alpha is the same, less quality is smaller") {
  for (const int channels : {3, 4}) {
    const Image image = picture(192, 96, channels);
    const std::vector<char> fine = encode_webp(image, {.lossless = false, .quality = 95}),
                            coarse = encode_webp(image, {.lossless = false, .quality = 40});
    CHECK(coarse.size() < fine.size());
    CHECK(fine.size() < encode_webp(image).size());
    const Image read = decode_image(fine, "w");
    CHECK(difference(image, read, 0, 3) > 0.5);
    CHECK(difference(image, read, 0, 3) < 40);
    CHECK(difference(by_png(image), read, 3, channels) == 0);
  }
}

TEST_CASE("webp: grey becomes RGB, values beyond 0 to 1 are clamped, bytes are the same again") {
  Image grey = picture(32, 16, 1), both = picture(32, 16, 2);
  grey.pixels[0] = -1;
  grey.pixels[1] = 7;
  const Image read = decode_image(encode_webp(grey), "w");
  REQUIRE(read.channels == 3);
  CHECK(read.pixels[0] == 0);
  CHECK(read.pixels[3] == 1);
  CHECK(*read.pixel(9, 9) == *by_png(grey).pixel(9, 9));
  CHECK(decode_image(encode_webp(both), "w").channels == 4);
  CHECK(encode_webp(both) == encode_webp(both));
}

TEST_CASE("webp: alpha that is 1 everywhere is left out") {
  Image image = picture(32, 16, 4);
  for (int i = 0; i < 32 * 16; ++i) image.pixels[4 * std::size_t(i) + 3] = 1;
  for (const bool lossless : {true, false})
    CHECK(decode_image(encode_webp(image, {.lossless = lossless}), "w").channels == 3);
}

TEST_CASE("webp: one colour over millions of texels is a hundred bytes, and read") {
  Image flat(4096, 2048, 3);
  std::fill(flat.pixels.begin(), flat.pixels.end(), 0.2F);
  const std::vector<char> bytes = encode_webp(flat);
  CHECK(bytes.size() < 1000);
  CHECK(difference(decode_image(bytes, "w"), flat, 0, 3) < 1e-4);
  CHECK_THROWS_WITH(decode_image(bytes, "w", {.decoded_megabytes = 20}),
                    Catch::Matchers::Contains("more than the limit of 20 MB"));
}

TEST_CASE("webp: what is too large is refused, and what is cut short") {
  CHECK_THROWS_WITH(encode_webp(Image(most_webp_side + 1, 1, 3)),
                    Catch::Matchers::Contains("at most 16383 texels a side, not 16384 x 1"));
  CHECK_THROWS_WITH(encode_webp(Image(1, most_webp_side + 1, 3)),
                    Catch::Matchers::Contains("at most 16383 texels a side, not 1 x 16384"));
  CHECK(decode_image(encode_webp(Image(most_webp_side, 1, 3)), "w").width == most_webp_side);
  for (const bool lossless : {true, false}) {
    const std::vector<char> whole = encode_webp(picture(64, 32, 4), {.lossless = lossless});
    for (std::size_t size = 12; size < whole.size(); size += 7)
      CHECK_THROWS_AS(decode_image({whole.begin(), whole.begin() + std::ptrdiff_t(size)}, "w"),
                      ImageError);
  }
}

TEST_CASE("webp: changed bytes give an image of the size that its head says, or an error") {
  std::mt19937 random(3);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::vector<char> bytes = encode_webp(picture(24, 12, 3 + i % 2), {.lossless = i % 4 < 2});
    for (int k = 0; k < 3; ++k) bytes[12 + random() % (bytes.size() - 12)] = char(random());
    try {
      const Image image = decode_image(bytes, "w", {.decoded_megabytes = 4});
      CHECK(image.pixels.size() == std::size_t(image.width) * image.height * image.channels);
    } catch (const ImageError&) {
      ++refused;
    }
  }
  CHECK(refused > 20);
  CHECK(refused < 400);
}
