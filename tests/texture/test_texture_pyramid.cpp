#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "srgb_curves.h"
#include "texture/texture_pyramid.h"

using namespace sphparam;

namespace {

/// Columns of black and white in turn.
Image stripes(int size) {
  Image image(size, size, 3);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = static_cast<float>(x % 2);
    }
  }
  return image;
}

/// Red is the column, green the row, as shares of the size, in linear light.
Image ramp(int width, int height) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.pixel(x, y)[0] = (static_cast<float>(x) + 0.5F) / static_cast<float>(width);
      image.pixel(x, y)[1] = (static_cast<float>(y) + 0.5F) / static_cast<float>(height);
    }
  }
  return image;
}

SourceTexture texture(const Image& image, TextureWrap wrap, bool linear) {
  return {.image = std::make_shared<const TexturePyramid>(image, linear, 1),
          .wrap_s = wrap,
          .wrap_t = wrap};
}

std::array<float, 4> at(const SourceTexture& t, double x, double y, double step_x = 0,
                        double below_y = 0, TextureFilter filter = TextureFilter::Bilinear) {
  std::array<float, 4> rgba;
  sample_texture(t, filter, {{x, y}, {step_x, 0}, {0, below_y}, 1}, rgba.data());
  return rgba;
}

}  // namespace

TEST_CASE("sRGB: the tables are the curves of the standard, and inverse to each other") {
  const SrgbCurves& curves = SrgbCurves::get();
  for (int i = 0; i <= 100000; ++i) {
    const double x = i / 100000.0;
    const double exact = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    REQUIRE(static_cast<double>(curves.to_linear(static_cast<float>(x))) ==
            Approx(exact).epsilon(1e-5).margin(1e-9));
    REQUIRE(static_cast<double>(curves.to_srgb(static_cast<float>(exact))) ==
            Approx(x).epsilon(1e-5).margin(1e-9));
  }
  CHECK(curves.to_srgb(-1) == 0);
  CHECK(curves.to_srgb(2) == 1);
  CHECK(curves.to_srgb(std::numeric_limits<float>::quiet_NaN()) == 0);
}

TEST_CASE("pyramid: every level has the mean of the image, also at odd sizes, in linear light") {
  for (const int size : {1, 2, 3, 7, 12, 33}) {
    const TexturePyramid pyramid(ramp(size, 2 * size + 1), true, 1);
    CHECK(pyramid.levels().back().width == 1);
    CHECK(pyramid.levels().back().height == 1);
    for (int c = 0; c < 2; ++c) {
      const auto mean = static_cast<double>(pyramid.levels().back().texels[static_cast<size_t>(c)]);
      CHECK(mean / 65535 == Approx(0.5).margin(2e-4));
    }
  }
  const TexturePyramid grey(stripes(8), false, 1);
  CHECK(grey.levels().back().texels[0] == Approx(32768).margin(2));  // half the light
}

TEST_CASE("sampling: bilinear and bicubic reproduce what is linear") {
  const SourceTexture t = texture(ramp(32, 16), TextureWrap::Clamp, true);
  for (const TextureFilter filter : {TextureFilter::Bilinear, TextureFilter::Bicubic}) {
    for (const double x : {0.2, 0.37, 0.5, 0.81}) {
      const auto rgba = at(t, x, 1 - x, 0.001, 0.001, filter);
      CHECK(static_cast<double>(rgba[0]) == Approx(x).margin(3e-5));
      CHECK(static_cast<double>(rgba[1]) == Approx(1 - x).margin(3e-5));
      CHECK(static_cast<double>(rgba[3]) == Approx(1));
    }
  }
}

TEST_CASE("sampling: many texels in one sample become their mean, whichever way they are many") {
  const SourceTexture t = texture(stripes(256), TextureWrap::Repeat, false);
  const SourceTexture turned = texture(ramp(256, 256), TextureWrap::Repeat, true);
  CHECK(static_cast<double>(at(t, 0.3, 0.3, 0.2, 0.2)[0]) == Approx(0.5).margin(0.01));
  CHECK(static_cast<double>(at(t, 0.3, 0.3, 0.2, 0.001)[0]) == Approx(0.5).margin(0.03));
  // Narrow along the stripes only: they stay sharp.
  const float dark = at(t, 0.5 / 256, 0.3, 0.5 / 256, 0.05)[0],
              light = at(t, 1.5 / 256, 0.3, 0.5 / 256, 0.05)[0];
  CHECK(light - dark > 0.9F);
  CHECK(static_cast<double>(at(turned, 0.5, 0.5, 0.1, 0.1)[0]) == Approx(0.5).margin(0.01));
}

TEST_CASE(
    "sampling: a texture that wants it is unfiltered where its texels are large, only there") {
  SourceTexture t = texture(stripes(8), TextureWrap::Repeat, false);
  const double x = 1.0 / 8 + 0.01, step = 1.0 / 64;  // just inside the second column
  CHECK(at(t, x, 0.5, step, step)[0] < 0.9F);
  t.nearest = true;
  CHECK(at(t, x, 0.5, step, step)[0] == 1);
  CHECK(at(t, x, 0.5, step, step, TextureFilter::Bicubic)[0] == 1);
  CHECK(static_cast<double>(at(t, x, 0.5, 1, 1)[0]) == Approx(0.5).margin(0.01));
}

TEST_CASE("sampling: wrap modes are those of glTF") {
  const Image image = ramp(16, 16);
  const auto red = [&](TextureWrap wrap, double x) {
    return static_cast<double>(at(texture(image, wrap, true), x, 0.5)[0]);
  };
  CHECK(red(TextureWrap::Repeat, 1.3) == Approx(0.3).margin(1e-4));
  CHECK(red(TextureWrap::Repeat, -0.7) == Approx(0.3).margin(1e-4));
  CHECK(red(TextureWrap::Mirror, 1.3) == Approx(0.7).margin(1e-4));
  CHECK(red(TextureWrap::Mirror, -0.3) == Approx(0.3).margin(1e-4));
  CHECK(red(TextureWrap::Clamp, 1.3) == Approx(31.0 / 32).margin(1e-4));
  CHECK(red(TextureWrap::Clamp, -5) == Approx(1.0 / 32).margin(1e-4));
  CHECK(red(TextureWrap::Repeat, 0) == Approx(0.5).margin(1e-4));  // between last and first
}

TEST_CASE("sampling: coordinates beyond all bounds do no harm") {
  const SourceTexture t = texture(stripes(4), TextureWrap::Repeat, false);
  for (const double x : {1e300, -1e300, 1e17}) {
    const auto rgba = at(t, x, x, x, x);
    CHECK(std::isfinite(rgba[0]));
  }
}
