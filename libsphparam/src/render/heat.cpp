#include "render/heat.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "elementary.h"
#include "number_text.h"
#include "render/lettering.h"

namespace sphparam {
namespace {

struct Tick {
  double value;
  std::string label;
};

std::string ratio_label(int log2) {
  const std::string power = std::to_string(1 << std::abs(log2));
  return log2 < 0 ? "1/" + power : power;
}

// Halves below: the ends of a scale may be farther apart than the largest double.

/// From 0 at the low end to 1 at the high one; 0 where they are one.
double share_of(const HeatScale& scale, double value) {
  const double half_span = scale.high / 2 - scale.low / 2;
  return half_span > 0 ? (value / 2 - scale.low / 2) / half_span : 0;
}

double value_at(const HeatScale& scale, double share) {
  return 2 * (scale.low / 2 + (scale.high / 2 - scale.low / 2) * share);
}

/// Where a value is, in pixels from the low end of a scale so wide.
int place_of(const HeatScale& scale, double value, int width) {
  return static_cast<int>(share_of(scale, value) * (width - 1));
}

/// Every so manieth power of two from the low end on.
std::vector<Tick> powers(const HeatScale& scale, int step) {
  std::vector<Tick> all;
  for (int k = static_cast<int>(std::ceil(scale.low)); k <= scale.high; k += step)
    all.push_back({static_cast<double>(k), ratio_label(k)});
  return all;
}

/// With so many digits.
std::vector<Tick> labelled(const std::vector<double>& values, int digits) {
  std::vector<Tick> all;
  for (const double value : values) all.push_back({value, short_number(value, digits)});
  return all;
}

/// The ends and, where wanted, the middle, with as many digits as tell them apart.
std::vector<Tick> ends(const HeatScale& scale, bool middle) {
  std::vector<double> values{scale.low, scale.high};
  if (middle) values.insert(values.begin() + 1, value_at(scale, 0.5));
  constexpr int fewest = 3, most = 17;
  std::vector<Tick> all = labelled(values, fewest);
  for (int digits = fewest + 1; digits <= most; ++digits) {
    if (std::ranges::adjacent_find(all, {}, &Tick::label) == all.end()) break;
    if (scale.low < scale.high) all = labelled(values, digits);
  }
  if (scale.given) {
    all.front().label = shortest(scale.low);
    all.back().label = shortest(scale.high);
  }
  if (scale.below) all.front().label = "< " + all.front().label;
  if (scale.above) all.back().label = "> " + all.back().label;
  return all;
}

/// Where a scale lies in a picture.
struct Strip {
  int left, width, dot, picture_width;

  /// Where the label of a tick begins: below it in the middle, and a blank away from the edges.
  int start(const HeatScale& scale, const Tick& tick) const {
    const int wide = text_width(tick.label, dot), rim = text_width(" ", dot);
    const int most = std::max(rim, picture_width - rim - wide);
    return std::clamp(left + place_of(scale, tick.value, width) - wide / 2, rim, most);
  }
};

/// Whether labels keep a letter's width from one another.
bool fit(const std::vector<Tick>& ticks, const HeatScale& scale, const Strip& strip) {
  for (size_t i = 1; i < ticks.size(); ++i) {
    const Tick &left = ticks[i - 1], &right = ticks[i];
    const int end = strip.start(scale, left) + text_width(left.label, strip.dot);
    if (strip.start(scale, right) < end + text_width("1", strip.dot)) return false;
  }
  return true;
}

/// Powers of two, all of them or so many that the ends and 1 are among them, or the ends and the
/// middle: as many as have room.
std::vector<Tick> ticks(const HeatScale& scale, const Strip& strip) {
  if (!scale.log_ratios) {
    std::vector<Tick> all = ends(scale, true);
    return fit(all, scale, strip) ? all : ends(scale, false);
  }
  const int low = static_cast<int>(std::ceil(scale.low));
  const int high = static_cast<int>(std::floor(scale.high)), span = high - low;
  for (int step = 1; step < span; ++step) {
    if (low % step != 0 || high % step != 0) continue;
    std::vector<Tick> some = powers(scale, step);
    if (fit(some, scale, strip)) return some;
  }
  return powers(scale, std::max(1, span));
}

void fill_column(Image& image, int x, int top, int height, const Rgb& colour) {
  for (int y = top; y < top + height; ++y) {
    std::fill_n(image.pixel(x, y), image.channels, 1.0F);
    std::copy_n(colour.data(), std::min(3, image.channels), image.pixel(x, y));
  }
}

void draw_scale(Image& image, const HeatScale& scale, const Strip& strip, int top) {
  const auto [left, width, dot, picture_width] = strip;
  const int line = text_height(dot);
  const Rgb ink(0.2F, 0.2F, 0.2F);
  draw_text(image, scale.title, left, top - line - 2 * dot, dot, ink);
  for (int x = 0; x < width; ++x) {
    fill_column(image, left + x, top, line, heat_colour(scale, value_at(scale, (x + 0.5) / width)));
  }
  for (const Tick& tick : ticks(scale, strip)) {
    fill_column(image, left + place_of(scale, tick.value, width), top, line + 2 * dot, ink);
    draw_text(image, tick.label, strip.start(scale, tick), top + line + 3 * dot, dot, ink);
  }
}

}  // namespace

Rgb heat_colour(const HeatScale& scale, double value) {
  if (scale.diverges()) return diverging(value / scale.high);
  return viridis(share_of(scale, value));
}

const HeatScale& heat_scale(Heat heat) {
  static const std::array<HeatScale, 3> scales = {
      {{"area ratio", -3, 3, true}, {"angle ratio", 0, 3, true}, {"stretch ratio", -3, 3, true}}};
  return scales[static_cast<size_t>(heat)];
}

VectorX heat_values(Heat heat, const Distortion& distortion) {
  const auto log2 = [](double x) { return elementary::log2(x); };
  switch (heat) {
    case Heat::Area:
      return distortion.area_ratio.unaryExpr(log2);
    case Heat::Angle:
      return distortion.angle_ratio.unaryExpr(log2).cwiseAbs().rowwise().mean();
    case Heat::Stretch:
      break;
  }
  const auto squeeze = distortion.sigma_max.array().square().inverse() +
                       distortion.sigma_min.array().square().inverse();
  return (squeeze / 2).unaryExpr(log2) / 2;
}

FacePaint heat_paint(Heat heat, const Distortion& distortion) {
  FacePaint paint;
  for (const double value : heat_values(heat, distortion)) {
    paint.colours.push_back(heat_colour(heat_scale(heat), value));
  }
  return paint;
}

Rgb heat_colour(Heat heat, double ratio) {
  return heat_colour(heat_scale(heat), elementary::log2(ratio));
}

Image with_legend(const Image& picture, const HeatScale& scale) {
  constexpr int least = 160, heights_a_dot = 400;  // pixels
  if (picture.height < least || picture.width < least) return picture;
  const int dot = std::max(1, picture.height / heights_a_dot), line = text_height(dot);
  Image image(picture.width, picture.height + 5 * line, picture.channels);
  std::fill(image.pixels.begin(), image.pixels.end(), 1.0F);
  std::copy(picture.pixels.begin(), picture.pixels.end(), image.pixels.begin());
  draw_scale(image, scale, {3 * line, picture.height / 2, dot, image.width},
             picture.height + 2 * line);
  return image;
}

Image with_legend(const Image& picture, Heat heat) {
  return with_legend(picture, heat_scale(heat));
}

}  // namespace sphparam
