#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace sphparam {

/// `std::from_chars`, which reports numbers below the smallest double like those above the largest:
/// here 1e-400 is the nearest double, as elsewhere in C. The wider range of long double tells them
/// apart.
inline std::from_chars_result double_from_text(const char* first, const char* last, double& value) {
  const std::from_chars_result result = std::from_chars(first, last, value);
  if (result.ec != std::errc::result_out_of_range) return result;
  long double wide = 0;
  const std::from_chars_result wider = std::from_chars(first, last, wide);
  if (wider.ec != std::errc{} || std::fabs(wide) > 1) return result;
  value = static_cast<double>(wide);
  return wider;
}

/// `parsed`, likewise.
inline std::optional<double> parsed_double(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = double_from_text(text.data(), end, value);
  return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

}  // namespace sphparam
