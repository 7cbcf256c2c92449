#include "gltf/usd/layer_text.h"

#include <algorithm>

namespace sphparam {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_of_name(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// How many bytes the character that a text begins with has; 0: it is not UTF-8. Neither are
/// surrogates, nor more bytes than a character needs.
std::size_t bytes_of_character(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  if (first < 0x80) return 1;
  const std::size_t count = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < count) return 0;
  char32_t code = first & (0x7FU >> count);
  for (const char next : text.substr(1, count - 1)) {
    if ((next & 0xC0) != 0x80) return 0;
    code = code << 6 | (next & 0x3F);
  }
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  const bool fits = count == 2 || (count == 3 ? code >= 0x800 : code >= 0x10000 && code < 0x110000);
  return fits && !is_surrogate ? count : 0;
}

/// A character of one byte.
std::string escaped(char c) {
  switch (c) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    case '"':
    case '\\':
      return {'\\', c};
    default:
      return {static_cast<unsigned char>(c) < ' ' ? ' ' : c};
  }
}

}  // namespace

void LayerText::indent() {
  for (int i = 0; i < depth_; ++i) text_ << "    ";
}

void LayerText::line(std::string_view pattern, Words words) {
  if (!pattern.empty()) indent();
  const auto* word = words.begin();
  for (const char c : pattern) c == '%' ? text_ << *word++ : text_ << c;
  text_ << '\n';
}

void LayerText::open(std::string_view pattern, Words words) {
  line(pattern, words);
  ++depth_;
}

void LayerText::close(std::string_view bracket) {
  --depth_;
  line(bracket);
}

void LayerText::put_rows(const FloatRows& rows) {
  const bool is_tuple = rows.cols() > 1;
  text_ << " = [";
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    if (i > 0) text_ << ", ";
    if (is_tuple) text_ << '(';
    for (Eigen::Index k = 0; k < rows.cols(); ++k) {
      if (k > 0) text_ << ", ";
      text_ << rows(i, k) + 0.0F;  // no -0
    }
    if (is_tuple) text_ << ')';
  }
  text_ << ']';
}

void LayerText::rows(std::string_view type_and_name, const FloatRows& rows) {
  indent();
  text_ << type_and_name;
  put_rows(rows);
  text_ << '\n';
}

void LayerText::varying_rows(std::string_view type_and_name, std::string_view what,
                             const FloatRows& rows) {
  indent();
  text_ << type_and_name;
  put_rows(rows);
  text_ << " (\n";
  ++depth_;
  line("interpolation = \"%\"", {what});
  close(")");
}

void LayerText::numbers(std::string_view type_and_name, const std::vector<std::uint32_t>& numbers) {
  indent();
  text_ << type_and_name << " = [";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) text_ << ", ";
    text_ << numbers[i];
  }
  text_ << "]\n";
}

std::string usd_string(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t count = bytes_of_character(text);
    quoted += count == 0   ? std::string("\xEF\xBF\xBD")
              : count == 1 ? escaped(text.front())
                           : std::string(text.substr(0, count));
    text.remove_prefix(std::max<std::size_t>(count, 1));
  }
  return quoted + "\"";
}

std::string usd_name(std::string_view text) {
  std::string name(text);
  std::ranges::replace_if(
      name, [](char c) { return !is_of_name(c); }, '_');
  return name.empty() || is_digit(name.front()) ? "_" + name : name;
}

}  // namespace sphparam
