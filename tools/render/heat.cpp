#include "render/heat.h"

#include <algorithm>
#include <cmath>

#include "render/lettering.h"

namespace sphparam::tools {
namespace {

constexpr double kFull = 8;  // the ratio of the last colour

struct Tick {
  double ratio;
  std::string label;
};

const std::vector<Tick>& ticks(Heat heat) {
  static const std::vector<Tick> area = {
      {1.0 / 8, "1/8"}, {1.0 / 4, "1/4"}, {1.0 / 2, "1/2"}, {1, "1"}, {2, "2"}, {4, "4"}, {8, "8"}};
  static const std::vector<Tick> angle = {{1, "1"}, {2, "2"}, {4, "4"}, {8, "8"}};
  return heat == Heat::Area ? area : angle;
}

void fill_column(Image& image, int x, int top, int height, const Rgb& colour) {
  for (int y = top; y < top + height; ++y) std::copy_n(colour.data(), 3, image.pixel(x, y));
}

}  // namespace

Rgb heat_colour(Heat heat, double ratio) {
  const double share = std::log(ratio) / std::log(kFull);
  return heat == Heat::Area ? diverging(share) : viridis(share);
}

FacePaint heat_paint(Heat heat, const Distortion& distortion) {
  if (heat == Heat::Area) return {ratio_colours(distortion.area_ratio, kFull)};
  const Eigen::VectorXd error = distortion.angle_ratio.array().log().abs().rowwise().mean();
  return {value_colours(error, 0, std::log(kFull))};
}

Image with_legend(const Image& picture, Heat heat) {
  constexpr int least = 160, heights_a_dot = 400;  // pixels
  if (picture.height < least || picture.width < least) return picture;
  const int dot = std::max(1, picture.height / heights_a_dot), line = text_height(dot);
  const int left = 2 * line, width = picture.height / 2, top = picture.height + 2 * line;
  Image image(picture.width, picture.height + 5 * line, picture.channels);
  std::fill(image.pixels.begin(), image.pixels.end(), 1.0F);
  std::copy(picture.pixels.begin(), picture.pixels.end(), image.pixels.begin());

  const Rgb ink(0.2F, 0.2F, 0.2F);
  const std::string title = heat == Heat::Area ? "area ratio" : "angle ratio";
  draw_text(image, title, left, top - line - 2 * dot, dot, ink);
  const double first = std::log(ticks(heat).front().ratio), last = std::log(kFull);
  for (int x = 0; x < width; ++x) {
    const double ratio = std::exp(first + (last - first) * (x + 0.5) / width);
    fill_column(image, left + x, top, line, heat_colour(heat, ratio));
  }
  for (const Tick& tick : ticks(heat)) {
    const double share = (std::log(tick.ratio) - first) / (last - first);
    const int x = left + static_cast<int>(share * (width - 1));
    fill_column(image, x, top, line + 2 * dot, ink);
    draw_text(image, tick.label, x - text_width(tick.label, dot) / 2, top + line + 3 * dot, dot,
              ink);
  }
  return image;
}

}  // namespace sphparam::tools
