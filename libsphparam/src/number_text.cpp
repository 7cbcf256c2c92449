#include "number_text.h"

#include <charconv>
#include <cmath>

namespace sphparam {

std::string short_number(double value, int digits) {
  char text[32];  // by no locale: the library may be part of a program that has set one
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  return {text, end.ptr};
}

std::string percent(double share, int digits) {
  constexpr double longest = 1e6;  // that people read digit by digit
  std::string text = short_number(100 * share, digits);
  if (text.find("e+") != std::string::npos && std::abs(100 * share) < longest)
    text = std::to_string(std::lround(100 * share));
  return text + " %";
}

std::string shortest(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

std::string counted(long count, std::string_view thing) {
  return std::to_string(count) + " " + std::string(thing) + (count == 1 ? "" : "s");
}

std::string counted(long count, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += between;
    text += words[i];
  }
  return text;
}

}  // namespace sphparam
