#include "bake/baked_chart.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace sphparam {
namespace {

constexpr std::string_view interpolation = "sphparam:interpolation",
                           wedges = "sphparam:refine_poles", all_in_one = "ImageDescription";

/// The value of "key=value" among some lines; empty: not there.
std::string_view value_in(std::string_view lines, std::string_view key) {
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    if (line.starts_with(key) && line.substr(key.size()).starts_with('='))
      return line.substr(key.size() + 1);
    lines.remove_prefix(std::min(lines.size(), line.size() + 1));
  }
  return {};
}

}  // namespace

std::string_view baked_text(const ImageTexts& texts, std::string_view key) {
  for (const auto& [name, text] : texts) {
    if (name == key) return text;
    if (name != all_in_one) continue;
    if (const std::string_view value = value_in(text, key); !value.empty()) return value;
  }
  return {};
}

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

std::optional<Convention> baked_convention_of(const ImageTexts& texts) {
  return convention_named(baked_text(texts, "sphparam:convention"));
}

}  // namespace sphparam
