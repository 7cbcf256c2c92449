#include "number_text.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace sphparam {

std::string short_number(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
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
  for (const std::string& word : words) {
    if (!text.empty()) text += between;
    text += word;
  }
  return text;
}

}  // namespace sphparam
