#include "texture/baked_texts.h"

#include <algorithm>

namespace sphparam {
namespace {

constexpr std::string_view all_in_one = "ImageDescription";

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

bool has_float_samples(const ImageTexts& texts) {
  const std::string_view samples = baked_text(texts, samples_text);
  return samples == "half" || samples == "float" || samples == "double";
}

bool is_measured(const ImageTexts& texts) {
  static constexpr std::string_view maps[] = {
      "position",  "height",    "lon",       "lat",  "lonlat", "radius",  "slope",
      "elevation", "thickness", "curvature", "area", "angle",  "stretch", "scalar"};
  const std::string_view map = baked_text(texts, "sphparam:map");
  const bool is_scaled = !baked_text(texts, "sphparam:min").empty();
  return !is_scaled && std::ranges::count(maps, map.substr(0, map.find(':'))) > 0;
}

std::optional<Convention> baked_convention_of(const ImageTexts& texts) {
  return convention_named(baked_text(texts, "sphparam:convention"));
}

}  // namespace sphparam
