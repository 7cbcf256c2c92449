// Checker and graticule are products of functions of u and of v, whose means over a texel are
// exact. The axes are sampled: one sample where no border is near, else a grid of them.

#include "texture/test_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "elementary.h"
#include "sphparam/parallel.h"
#include "srgb_curves.h"
#include "texture/axis_letters.h"

namespace sphparam {
namespace {

using Rgb = Eigen::Vector3f;
constexpr double pi = std::numbers::pi;
constexpr int column_count = 24, row_count = 12;  // fields of 15°
constexpr int polar_columns = 4;                  // meridians that run on to the poles
constexpr double half_line = 0.006;               // radians: half the thickness of a line …
constexpr double strong_line = 2 * half_line;     // … of equator and date line
constexpr int samples = 8;                        // a side, of a texel on a border
constexpr std::int64_t grain = 8;                 // rows

struct Interval {
  double low, high;
  double middle() const { return (low + high) / 2; }
};

Rgb linear(const Rgb& srgb) {
  return srgb.unaryExpr([](float c) { return SrgbCurves::get().to_linear(c); });
}

void store(const Rgb& linear, float* rgb) {
  for (int c = 0; c < 3; ++c) rgb[c] = SrgbCurves::get().to_srgb(linear[c]);
}

/// The longitudes of a column, in turns of ours; not reduced to [0, 1).
Interval longitudes(int column, int width, const ConventionInfo& convention) {
  const auto ours = [&](int edge) {
    return convention.turns * (static_cast<double>(edge) / width - convention.offset);
  };
  const double one = ours(column), other = ours(column + 1);
  return {std::min(one, other), std::max(one, other)};
}

/// Mean over [low, high] of +1 on [0, 1), −1 on [1, 2), and so on: of period 2.
double mean_square_wave(double low, double high) {
  const auto integral = [](double x) { return std::abs(x - 2 * std::floor(x / 2 + 0.5)); };
  return (integral(high) - integral(low)) / (high - low);
}

/// Share of [low, high] within `half` of a whole number.
double share_of_lines(double low, double high, double half) {
  if (half >= 0.5) return 1;
  const auto integral = [half](double x) {
    const double nearest = std::round(x);
    return 2 * half * nearest + std::clamp(x - nearest, -half, half);
  };
  return std::clamp((integral(high) - integral(low)) / (high - low), 0.0, 1.0);
}

Rgb checker(const Interval& u, const Interval& v) {
  static const Rgb light = linear({0.93F, 0.92F, 0.88F}), dark = linear({0.22F, 0.42F, 0.55F});
  const double waves = mean_square_wave(u.low * column_count, u.high * column_count) *
                       mean_square_wave(v.low * row_count, v.high * row_count);
  const auto share = static_cast<float>((1 + waves) / 2);
  return dark + share * (light - dark);
}

/// The share that lines have of what a strong line leaves.
float share_of_rest(double lines, double strong) {
  return strong < 1 ? static_cast<float>(std::clamp(lines / (1 - strong), 0.0, 1.0)) : 0;
}

Rgb graticule(const Interval& u, const Interval& v) {
  static const Rgb ground = linear({0.94F, 0.94F, 0.92F}), line = linear({0.25F, 0.28F, 0.32F}),
                   equator = linear({0.10F, 0.33F, 0.75F}), date = linear({0.84F, 0.05F, 0.08F});
  // Lines keep their thickness on the sphere: towards the poles they take more of u.
  const double radius = elementary::sin(pi * v.middle());
  const bool at_pole = std::min(v.middle(), 1 - v.middle()) * row_count < 1;
  const auto along = [&](double half, int lines) {
    return share_of_lines(u.low * lines, u.high * lines,
                          half / (2 * pi * std::max(radius, half)) * lines);
  };
  const auto across = [&](double half, double from, int lines) {
    return share_of_lines((v.low - from) * lines, (v.high - from) * lines, half / pi * lines);
  };
  const double date_share = along(strong_line, 1), equator_share = across(strong_line, 0.5, 1);
  const double meridians =
      along(half_line, at_pole ? polar_columns : column_count) - along(half_line, 1);
  const double parallels = across(half_line, 0, row_count) - across(half_line, 0.5, 1);
  Rgb colour = ground;
  colour += share_of_rest(meridians, date_share) * (line - colour);
  colour += share_of_rest(parallels, equator_share) * (line - colour);
  colour += static_cast<float>(equator_share) * (equator - colour);
  colour += static_cast<float>(date_share) * (date - colour);
  return colour;
}

/// Directions of a row's points: the same turns of longitude in every row.
struct Turn {
  double cosine, sine;
};
Turn turn_of(double u) { return {elementary::cos(2 * pi * u), elementary::sin(2 * pi * u)}; }
Vector3 direction(const Turn& turn, double v) {
  const double radius = elementary::sin(pi * v);
  return {turn.cosine * radius, turn.sine * radius, elementary::cos(pi * v)};
}

Rgb axes(const Interval& u, const Interval& v, const Turn& middle) {
  // From the middle of a texel no point of it is farther than half its height and width.
  const double reach = pi / 2 * (v.high - v.low) + pi * (u.high - u.low);
  const AxisPoint centre = axis_picture(direction(middle, v.middle()));
  if (centre.margin > reach) return linear(centre.colour);
  Rgb sum = Rgb::Zero();
  for (int i = 0; i < samples; ++i) {
    const Turn turn = turn_of(u.low + (u.high - u.low) * (i + 0.5) / samples);
    for (int j = 0; j < samples; ++j) {
      const double at = v.low + (v.high - v.low) * (j + 0.5) / samples;
      sum += linear(axis_picture(direction(turn, at)).colour);
    }
  }
  return sum / (samples * samples);
}

}  // namespace

const char* name_of(TestImage image) {
  constexpr std::array<const char*, 3> names = {"axes", "checker", "graticule"};
  return names[static_cast<size_t>(image)];
}

std::optional<TestImage> test_image_named(std::string_view name) {
  for (const TestImage image : {TestImage::Axes, TestImage::Checker, TestImage::Graticule}) {
    if (name == name_of(image)) return image;
  }
  return std::nullopt;
}

void draw_test_rows(TestImage image, int width, int height, Convention convention, int first_row,
                    int rows, float* rgb, int threads) {
  std::vector<Interval> columns;
  std::vector<Turn> middles;
  for (int x = 0; x < width; ++x) {
    columns.push_back(longitudes(x, width, info_of(convention)));
    middles.push_back(turn_of(columns.back().middle()));
  }
  parallel_for(rows, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t row = first; row < last; ++row) {
      const double y = static_cast<double>(first_row + row);
      const Interval v = {y / height, (y + 1) / height};
      float* out = rgb + 3 * row * width;
      for (size_t x = 0; x < columns.size(); ++x, out += 3) {
        store(image == TestImage::Axes      ? axes(columns[x], v, middles[x])
              : image == TestImage::Checker ? checker(columns[x], v)
                                            : graticule(columns[x], v),
              out);
      }
    }
  });
}

Image make_test_image(TestImage image, int width, Convention convention, int threads) {
  Image result(width, std::max(1, width / 2), 3);
  draw_test_rows(image, width, result.height, convention, 0, result.height, result.pixels.data(),
                 threads);
  return result;
}

}  // namespace sphparam
