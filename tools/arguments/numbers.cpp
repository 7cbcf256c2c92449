#include "arguments/numbers.h"

namespace sphparam::cli {

std::optional<std::pair<int, int>> two_numbers(const std::string& text, char between) {
  std::pair<int, int> numbers;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, numbers.first);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != between) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, numbers.second);
  const bool good = second.ec == std::errc{} && second.ptr == end;
  return good ? std::optional(numbers) : std::nullopt;
}

std::optional<Amount> amount_of(std::string text) {
  Amount amount{.percent = text.ends_with('%')};
  if (amount.percent) text.pop_back();
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, amount.value);
  return error == std::errc{} && stop == end ? std::optional(amount) : std::nullopt;
}

}  // namespace sphparam::cli
