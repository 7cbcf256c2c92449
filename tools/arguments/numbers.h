#pragma once

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "number_text.h"

namespace sphparam::cli {

/// From the least to the greatest, both allowed.
template <class Number>
struct Range {
  Number least = 0;
  Number most = std::numeric_limits<Number>::max();
  std::string words = {};  // empty: "2 to 5", or "2 on" where there is no end

  bool holds(Number value) const { return value >= least && value <= most; }
  std::string text() const {
    if (!words.empty()) return words;
    const bool ends = most != std::numeric_limits<Number>::max();
    return in_words(least) + (ends ? " to " + in_words(most) : " on");
  }

 private:
  static std::string in_words(Number number) {
    if constexpr (std::is_integral_v<Number>) return std::to_string(number);
    return shortest(static_cast<double>(number));
  }
};

/// What is wrong with a text as a decimal number of this range; empty: nothing. (CLI11 takes 010
/// for 8, and 0x10 for 16.)
template <class Number>
std::string complaint_of_number(const std::string& text, const Range<Number>& range) {
  Number value{};
  const std::string digits = text.substr(text.starts_with('+') ? 1 : 0);
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, value);
  bool good = error == std::errc{} && stop == end && range.holds(value);
  if constexpr (std::is_integral_v<Number>) good &= digits == std::to_string(value);
  if (good) return "";
  std::string complaint = "expected a number from " + range.text();
  if constexpr (std::is_floating_point_v<Number>) {
    std::string pointed = text;
    std::replace(pointed.begin(), pointed.end(), ',', '.');
    if (pointed != text && complaint_of_number(pointed, range).empty())
      complaint += ", with a point: " + pointed;
  }
  return complaint;
}

/// 17 and 23 of "17,23".
std::optional<std::pair<int, int>> two_numbers(const std::string& text, char between);

/// "0.5", or "50%".
struct Amount {
  double value = 0;
  bool percent = false;

  double of(double whole) const { return percent ? value / 100 * whole : value; }
};
std::optional<Amount> amount_of(std::string text);

}  // namespace sphparam::cli
