#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sphparam/sphere/spherical_coordinates.h"
#include "srgb_curves.h"
#include "texture/test_images.h"

using namespace sphparam;

namespace {

constexpr double pi = std::numbers::pi;
constexpr TestImage all[] = {TestImage::Axes, TestImage::Checker, TestImage::Graticule};

/// The texel in a direction, of an image in our convention.
Eigen::Vector3f colour_at(const Image& image, const Vector3& direction) {
  const SphericalCoordinates place = to_spherical(direction);
  const int x = static_cast<int>(place.theta / (2 * pi) * image.width) % image.width;
  const int y = std::min(image.height - 1, static_cast<int>(place.phi / pi * image.height));
  return Eigen::Map<const Eigen::Vector3f>(image.pixel(x, y));
}

bool is_light(const Eigen::Vector3f& colour) { return colour.minCoeff() > 0.9F; }

double linear_mean(const Image& image, int x0, int y0, int size, int channel) {
  double sum = 0;
  for (int y = y0; y < y0 + size; ++y) {
    for (int x = x0; x < x0 + size; ++x) {
      sum += SrgbCurves::get().to_linear(image.pixel(x, y)[channel]);
    }
  }
  return sum / (size * size);
}

}  // namespace

TEST_CASE("axes: seen from outside with north up, the sign stands to the left of its letter") {
  const Image image = make_test_image(TestImage::Axes, 1024);
  for (const Vector3& outward : {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 1, 0),
                                 Vector3(0, -1, 0), Vector3(0, 0, 1), Vector3(0, 0, -1)}) {
    const Vector3 up = outward.z() != 0 ? Vector3(0, 1, 0) : Vector3(0, 0, 1);
    const Vector3 right = up.cross(outward);
    INFO("axis " << outward.transpose());
    CHECK(is_light(colour_at(image, outward - 0.45 * right)));        // the stroke of the sign
    CHECK_FALSE(is_light(colour_at(image, outward + 0.45 * right)));  // no letter is there
    // Only plus has an upper arm.
    const bool plus = outward.sum() > 0;
    CHECK(is_light(colour_at(image, outward - 0.34 * right + 0.15 * up)) == plus);
  }
}

TEST_CASE("axes: the Z of both poles is no mirrored Z") {
  const Image image = make_test_image(TestImage::Axes, 1024);
  for (const double side : {1.0, -1.0}) {
    const Vector3 outward(0, 0, side), up(0, 1, 0), right = up.cross(outward);
    CHECK(is_light(colour_at(image, outward + 0.395 * right + 0.16 * up)));
    CHECK(is_light(colour_at(image, outward + 0.185 * right - 0.16 * up)));
    CHECK_FALSE(is_light(colour_at(image, outward + 0.185 * right + 0.16 * up)));
    CHECK_FALSE(is_light(colour_at(image, outward + 0.395 * right - 0.16 * up)));
  }
}

TEST_CASE("test images: a coarse texel is the mean of the fine ones in linear light") {
  constexpr int ratio = 16;
  for (const TestImage kind : all) {
    const Image fine = make_test_image(kind, 1024), coarse = make_test_image(kind, 64);
    // Lines are as thick as in the middle of a texel; letters are sampled.
    const double tolerance = kind == TestImage::Checker ? 1e-3 : 0.06;
    double worst = 0;
    for (int y = 6; y < coarse.height - 6; ++y) {
      for (int x = 0; x < coarse.width; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double expected = linear_mean(fine, x * ratio, y * ratio, ratio, c);
          const double found = SrgbCurves::get().to_linear(coarse.pixel(x, y)[c]);
          worst = std::max(worst, std::abs(found - expected));
        }
      }
    }
    INFO(name_of(kind));
    CHECK(worst < tolerance);
  }
}

TEST_CASE("checker: its mean light is the same at any size, also where fields share texels") {
  for (const int width : {24, 50, 334, 1000}) {
    const Image image = make_test_image(TestImage::Checker, width);
    double sum = 0;
    for (size_t i = 0; i < image.pixels.size(); i += 3) {
      sum += SrgbCurves::get().to_linear(image.pixels[i]);
    }
    const double light = SrgbCurves::get().to_linear(0.93F),
                 dark = SrgbCurves::get().to_linear(0.22F);
    CHECK(sum / (width * image.height) == Approx((light + dark) / 2).epsilon(1e-4));
  }
}

TEST_CASE("graticule: a red date line, a blue equator, lines as thick at every latitude") {
  const Image image = make_test_image(TestImage::Graticule, 2048);
  const float* date = image.pixel(0, 700);
  CHECK(date[0] > 2 * date[1]);
  CHECK(std::equal(date, date + 3, image.pixel(2047, 700)));
  const float* equator = image.pixel(900, 511);
  CHECK(equator[2] > 2 * equator[0]);
  const auto dark_in_row = [&](int y) {
    int count = 0;
    for (int x = 100; x < 1948; ++x) count += image.pixel(x, y)[0] < 0.6F;
    return count * std::sin(pi * (y + 0.5) / image.height);
  };
  CHECK(dark_in_row(300) == Approx(dark_in_row(550)).epsilon(0.25));
}

TEST_CASE("test images: conventions turn and mirror the same picture") {
  constexpr int width = 96, half = width / 2;
  for (const TestImage kind : all) {
    const Image ours = make_test_image(kind, width);
    const Image gis = make_test_image(kind, width, Convention::Gis);
    const Image blender = make_test_image(kind, width, Convention::Blender);  // u = ½ − u₀
    for (int y = 0; y < ours.height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Eigen::Map<const Eigen::Vector3f> here(ours.pixel(x, y));
        const Eigen::Map<const Eigen::Vector3f> turned(gis.pixel((x + half) % width, y));
        const Eigen::Map<const Eigen::Vector3f> mirrored(
            blender.pixel((width + half - 1 - x) % width, y));
        REQUIRE((here - turned).cwiseAbs().maxCoeff() < 2e-2F);
        REQUIRE((here - mirrored).cwiseAbs().maxCoeff() < 2e-2F);
      }
    }
  }
}

TEST_CASE("test images: rows drawn apart are those of the whole, for any number of threads") {
  for (const TestImage kind : all) {
    const Image whole = make_test_image(kind, 80, Convention::Sphparam, 3);
    Image rows(80, 40, 3);
    draw_test_rows(kind, 80, 40, Convention::Sphparam, 0, 13, rows.pixel(0, 0), 1);
    draw_test_rows(kind, 80, 40, Convention::Sphparam, 13, 27, rows.pixel(0, 13), 2);
    CHECK(whole.pixels == rows.pixels);
    CHECK(test_image_named(name_of(kind)) == kind);
  }
  CHECK_FALSE(test_image_named("chequers"));
  CHECK(make_test_image(TestImage::Axes, 1).height == 1);
}
