#include "io/files/base64.h"

#include <algorithm>
#include <array>

namespace sphparam {
namespace {

constexpr std::string_view alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr int no_digit = -1;

constexpr std::array<std::int8_t, 256> digits = [] {
  std::array<std::int8_t, 256> table{};
  table.fill(no_digit);
  for (std::size_t i = 0; i < alphabet.size(); ++i)
    table[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
  return table;
}();

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

std::string to_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? alphabet[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

bool Base64Reader::read(std::uint64_t count, std::string& bytes) {
  if (count > most_remaining()) return false;
  while (count > 0) {
    if (ready_.empty() && !decode_group()) return false;
    const auto taken = static_cast<std::size_t>(std::min<std::uint64_t>(count, ready_.size()));
    bytes.append(ready_, 0, taken);
    ready_.erase(0, taken);
    count -= taken;
  }
  return true;
}

bool Base64Reader::decode_group() {
  std::uint32_t group = 0;
  int filling = 0;
  for (int i = 0; i < 4; ++i) {
    while (!text_.empty() && is_blank(text_.front())) text_.remove_prefix(1);
    if (text_.empty()) return false;
    const char c = text_.front();
    text_.remove_prefix(1);
    const int digit = digits[static_cast<unsigned char>(c)];
    filling += c == '=';
    if ((digit == no_digit && c != '=') || (filling > 0 && c != '=')) return false;
    group = group << 6 | static_cast<std::uint32_t>(std::max(digit, 0));
  }
  if (filling > 2) return false;
  for (int i = 0; i < 3 - filling; ++i) ready_ += static_cast<char>(group >> (16 - 8 * i) & 255);
  return true;
}

}  // namespace sphparam
