#include "io/files/float32_digits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "parsed_number.h"

namespace sphparam {
namespace {

/// What a unit of the last digit is: 0.01 of 12.34, 100 of 1.2e3.
double unit_of_last_digit(std::string_view text) {
  const std::size_t mark = std::min(text.find_first_of("eE"), text.size());
  const std::size_t point = text.substr(0, mark).find('.');
  int exponent = point == std::string_view::npos ? 0 : -static_cast<int>(mark - point - 1);
  std::string_view written = text.substr(std::min(mark + 1, text.size()));
  if (written.starts_with('+')) written.remove_prefix(1);
  exponent += parsed<int>(written).value_or(0);
  return parsed<double>("1e" + std::to_string(exponent)).value_or(0);  // of no text that is one
}

/// As digits go, few enough for any float32: its step is less than half a unit of the last one.
bool is_short(std::string_view text) {
  constexpr std::ptrdiff_t always_held = 6;
  const std::string_view number = text.substr(0, text.find_first_of("eE"));
  const std::size_t first = number.find_first_of("123456789");
  if (first == std::string_view::npos) return true;
  const std::string_view digits = number.substr(first);
  return std::ssize(digits) - std::ranges::count(digits, '.') <= always_held;
}

}  // namespace

bool exceeds_float32(std::string_view text, double value) {
  if (is_short(text)) return false;
  constexpr double least = std::numeric_limits<float>::min();
  // A float that lies in the middle of two texts may be printed as either.
  constexpr double half = 0.5 + 1e-6;
  const double off = std::abs(value - rounded_to_float32(value));
  return off > 0 && std::abs(value) >= least && off > half * unit_of_last_digit(text);
}

}  // namespace sphparam
