#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace sphparam {

/// The number that all of a text is, a point before its fraction whatever the locale; nothing for
/// one with a plus sign or blanks, and for one that is out of range.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

}  // namespace sphparam
