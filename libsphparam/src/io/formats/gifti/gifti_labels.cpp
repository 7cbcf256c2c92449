#include "io/formats/gifti/gifti_labels.h"

#include <charconv>
#include <cmath>

#include "parsed_number.h"
#include "sphparam/io/mesh_file.h"
#include "take_word.h"

namespace sphparam {
namespace {

constexpr std::string_view prefix = "gifti label ";

std::string shortest(float number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

}  // namespace

std::string comment_of(const Label& label) { return std::string(prefix) + label_text(label); }

std::string label_text(const Label& label) {
  std::string text = std::to_string(label.key);
  if (label.colour) {
    for (const float channel : *label.colour) text += " " + shortest(channel);
  } else {
    text += " -";
  }
  return text + " " + one_line(label.name);
}

std::optional<Label> label_in(std::string_view comment) {
  if (!comment.starts_with(prefix)) return std::nullopt;
  return parse_label(comment.substr(prefix.size()));
}

std::optional<Label> parse_label(std::string_view text) {
  Label label;
  const auto key = parsed<decltype(label.key)>(take_word(text));
  if (!key) return std::nullopt;
  label.key = *key;
  if (text == "-" || text.starts_with("- ")) {
    take_word(text);
  } else {
    label.colour.emplace();
    for (float& channel : *label.colour) {
      const std::optional<float> value = parsed<float>(take_word(text));
      if (!value || !std::isfinite(*value)) return std::nullopt;
      channel = *value;
    }
  }
  label.name = text;
  return label;
}

}  // namespace sphparam
