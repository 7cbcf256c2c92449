#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "render/heat.h"
#include "render/lettering.h"

using namespace sphparam;

namespace {

Image white(int width, int height) {
  Image image(width, height, 3);
  std::fill(image.pixels.begin(), image.pixels.end(), 1.0F);
  return image;
}

long dark_pixels(const Image& image) {
  long count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) count += image.pixel(x, y)[0] < 0.5F;
  }
  return count;
}

}  // namespace

TEST_CASE("heat_paint: white where areas are kept, dark where angles are, full at a factor of 8") {
  Distortion d;
  d.area_ratio = (Eigen::VectorXd(3) << 1, 8, 1.0 / 8).finished();
  d.angle_ratio.resize(3, 3);
  d.angle_ratio << 1, 1, 1, 8, 8, 1.0 / 8, 2, 0.5, 2;
  const auto area = heat_paint(Heat::Area, d).colours, angle = heat_paint(Heat::Angle, d).colours;
  CHECK(area[0] == diverging(0));
  CHECK(area[1] == diverging(1));
  CHECK(area[2] == diverging(-1));
  CHECK((angle[0] - viridis(0)).norm() < 1e-6F);
  CHECK((angle[1] - viridis(1)).norm() < 1e-6F);
  CHECK((angle[2] - viridis(1.0 / 3)).norm() < 1e-6F);  // ln 2 / ln 8
  CHECK(heat_colour(Heat::Area, 8) == diverging(1));
}

TEST_CASE("with_legend: the scale runs from its first to its last colour, small pictures stay") {
  for (const Heat heat : {Heat::Area, Heat::Angle}) {
    const Image image = with_legend(white(400, 400), heat);
    CHECK(image.width == 400);
    CHECK(image.height > 400);
    CHECK(std::all_of(image.pixels.begin(), image.pixels.begin() + 400 * 400 * 3,
                      [](float value) { return value == 1; }));
    bool first = false, last = false;
    const double low = heat == Heat::Area ? 1.0 / 8 : 1;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const Rgb colour(image.pixel(x, y));
        first = first || (colour - heat_colour(heat, low * 1.02)).norm() < 0.03F;
        last = last || (colour - heat_colour(heat, 7.9)).norm() < 0.03F;
      }
    }
    CHECK(first);
    CHECK(last);
    CHECK(with_legend(white(100, 100), heat).pixels == white(100, 100).pixels);
  }
}

TEST_CASE("with_legend: a scale may be as wide as all doubles, or a single value") {
  constexpr double largest = std::numeric_limits<double>::max();
  const Image picture = white(400, 200);
  const HeatScale unit{"x", -1, 1}, widest{"x", -largest, largest}, single{"x", 2, 2};
  // The same strip but for its numbers: the first line below the title.
  const Image expected = with_legend(picture, unit), found = with_legend(picture, widest);
  const int row = picture.height + 2 * text_height(1) + 1, left = 3 * text_height(1);
  for (const int x : {1, 20, 49, 80, 98}) {
    for (int k = 0; k < 3; ++k) {
      CHECK(found.pixel(left + x, row)[k] ==
            Catch::Detail::Approx(expected.pixel(left + x, row)[k]));
    }
  }
  CHECK(with_legend(picture, single).height == expected.height);
}

TEST_CASE(
    "with_legend: numbers that have no room beside one another are left out, never the ends") {
  const auto numbers = [](int size, const HeatScale& scale) {
    const Image image = with_legend(white(size, size), scale);
    Image strip = white(size, text_height(1));
    const int first = size + 3 * text_height(1) + 3;  // the row where they begin
    std::copy_n(image.pixel(0, first), strip.pixels.size(), strip.pixels.begin());
    return dark_pixels(strip);
  };
  const auto dots = [](const std::vector<std::string>& labels) {
    Image image = white(1000, 20);
    int at = 0;
    for (const std::string& label : labels) draw_text(image, label, at += 100, 5, 1, Rgb::Zero());
    return dark_pixels(image);
  };
  const HeatScale& area = heat_scale(Heat::Area);
  CHECK(numbers(399, area) == dots({"1/8", "1/4", "1/2", "1", "2", "4", "8"}));
  CHECK(numbers(200, area) == dots({"1/8", "1", "8"}));
  CHECK(numbers(200, heat_scale(Heat::Angle)) == dots({"1", "2", "4", "8"}));
  HeatScale clipped{"x", 0.099972, 0.099978};  // a number that would begin beyond the left edge
  clipped.below = true;
  CHECK(numbers(400, clipped) == dots({"< 0.099972", "0.099975", "0.099978"}));
  const Image legend = with_legend(white(400, 400), clipped);
  for (int y = 400; y < legend.height; ++y)
    for (int x = 0; x < text_width(" ", 1); ++x) CHECK(legend.pixel(x, y)[0] == 1);
  HeatScale typed{"x", 100.4, 200.6};
  typed.given = true;
  CHECK(numbers(400, typed) == dots({"100.4", "150", "200.6"}));
  const HeatScale plain{"x", 0, 0.5}, wide{"x", 0.001234, 0.005678};
  CHECK(numbers(200, plain) == dots({"0", "0.25", "0.5"}));
  CHECK(numbers(160, wide) == dots({"0.00123", "0.00568"}));
  const HeatScale narrow{"x", 0.09996, 0.1}, beyond{"x", 0, 0.5, false, true, true};
  CHECK(numbers(400, narrow) == dots({"0.09996", "0.09998", "0.1"}));
  CHECK(numbers(200, beyond) == dots({"< 0", "0.25", "> 0.5"}));
  CHECK(numbers(200, {"x", 0, 0.5, false, false, true}) == dots({"0", "0.25", "> 0.5"}));
}

TEST_CASE("draw_text: dots of the letters, as large as asked, cut off at the rim") {
  Image image = white(60, 20);
  draw_text(image, "1", 5, 5, 1, Rgb::Zero());
  CHECK(dark_pixels(image) == 10);
  Image large = white(60, 20);
  draw_text(large, "1", 5, 1, 2, Rgb::Zero());
  CHECK(dark_pixels(large) == 40);
  CHECK(text_width("18", 2) == 22);
  for (const int x : {-100, -3, 58, 1000}) draw_text(image, "888", x, -4, 3, Rgb::Zero());
  Image none = white(60, 20);
  draw_text(none, " ?", 5, 5, 1, Rgb::Zero());
  CHECK(dark_pixels(none) == 0);
  Image capital = white(60, 20);
  draw_text(capital, "T_", 5, 5, 1, Rgb::Zero());
  CHECK(dark_pixels(capital) == 5 + 6 + 5);
}
