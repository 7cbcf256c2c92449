#include "showcase/heat_key.h"

#include <cmath>

#include "report/svg.h"

namespace sphparam {
namespace {

std::string css_colour(const Rgb& colour) {
  std::string text = "rgb(";
  for (int c = 0; c < 3; ++c) {
    text += c > 0 ? "," : "";
    text += std::to_string(std::lround(255 * colour[c]));
  }
  return text + ")";
}

/// "1/4" of −2, "4" of 2.
std::string power_of_two(int exponent) {
  std::string text = exponent < 0 ? "1/" : "";
  return text += std::to_string(1 << std::abs(exponent));
}

}  // namespace

std::string heat_key(Heat heat) {
  constexpr int stops = 16;
  const HeatScale& scale = heat_scale(heat);
  std::string colours;
  for (int i = 0; i <= stops; ++i) {
    const double value = scale.low + (scale.high - scale.low) * i / stops;
    colours += ",";
    colours += css_colour(heat_colour(scale, value));
  }
  std::string html = "<div class=\"heat-key\"><span class=\"name\">" + escaped(scale.title) +
                     "</span><span class=\"bar\" style=\"background:linear-gradient(90deg" +
                     colours + ")\"></span><span class=\"ticks\">";
  for (int tick = static_cast<int>(scale.low); tick <= static_cast<int>(scale.high); ++tick) {
    html += "<span>" + power_of_two(tick) + "</span>";
  }
  return html + "</span></div>\n";
}

}  // namespace sphparam
