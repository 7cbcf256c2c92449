#include "bake/baked_chart.h"

#include <charconv>
#include <string>
#include <string_view>

#include "texture/baked_texts.h"

namespace sphparam {
namespace {

constexpr std::string_view interpolation = "sphparam:interpolation",
                           wedges = "sphparam:refine_poles";

}  // namespace

ImageTexts texts_of_chart(bool linear_in_uv, int pole_wedges) {
  return {{std::string(interpolation), linear_in_uv ? "uv" : "sphere"},
          {std::string(wedges), std::to_string(pole_wedges)}};
}

std::optional<int> pole_wedges_of(const ImageTexts& texts) {
  if (baked_text(texts, interpolation) != "uv") return std::nullopt;
  const std::string_view text = baked_text(texts, wedges);
  int number = 1;  // what was baked before this was told
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace sphparam
