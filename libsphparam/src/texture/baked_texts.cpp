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

std::optional<Convention> baked_convention_of(const ImageTexts& texts) {
  return convention_named(baked_text(texts, "sphparam:convention"));
}

}  // namespace sphparam
