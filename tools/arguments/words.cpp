// Edit distance with swaps of neighbours (Damerau 1964, the restricted form): insertions,
// deletions, replacements and swaps cost one each. A word is "meant" when at most a third of it
// must be changed.

#include "arguments/words.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>

#include "arguments/numbers.h"
#include "console/exit_codes.h"

namespace sphparam::cli {

namespace {

size_t edit_distance(const std::string& a, const std::string& b) {
  const size_t columns = b.size() + 1;
  std::vector<size_t> table((a.size() + 1) * columns);
  const auto d = [&](size_t i, size_t j) -> size_t& { return table[i * columns + j]; };
  for (size_t i = 0; i <= a.size(); ++i) d(i, 0) = i;
  for (size_t j = 0; j <= b.size(); ++j) d(0, j) = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t replace = d(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      d(i, j) = std::min({d(i - 1, j) + 1, d(i, j - 1) + 1, replace});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d(i, j) = std::min(d(i, j), d(i - 2, j - 2) + 1);
    }
  }
  return d(a.size(), b.size());
}

}  // namespace

Words split(const std::string& text) {
  Words parts;
  std::stringstream rest(text);
  for (std::string part; std::getline(rest, part, ',');) parts.push_back(part);
  return text.empty() ? Words{""} : parts;
}

Words split_all(const Words& texts) {
  Words all;
  for (const std::string& text : texts)
    for (std::string& word : split(text))
      if (!word.empty()) all.push_back(std::move(word));
  return all;
}

std::optional<std::array<double, 3>> three_numbers(const std::string& text) {
  const Words words = split(text);
  std::array<double, 3> values;
  if (words.size() != values.size()) return std::nullopt;
  for (size_t i = 0; i < values.size(); ++i) {
    const Range<double> any = {std::numeric_limits<double>::lowest()};
    if (!complaint_of_number(words[i], any).empty()) return std::nullopt;
    const bool plus = words[i].starts_with('+');
    std::from_chars(words[i].data() + plus, words[i].data() + words[i].size(), values[i]);
  }
  return values;
}

std::optional<std::pair<std::string, std::string>> name_and_file(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) return std::nullopt;
  return std::pair(text.substr(0, equals), text.substr(equals + 1));
}

std::string nearest_word(const std::string& typed, const Words& known) {
  // The table is quadratic; nobody means a known word by a very long one.
  constexpr size_t longest = 64;
  std::string nearest;
  size_t least = std::max<size_t>(1, typed.size() / 3) + 1;
  if (typed.size() > longest) return nearest;
  for (const std::string& word : known) {
    const size_t distance = edit_distance(typed, word);
    if (distance < least) {
      least = distance;
      nearest = word;
    }
  }
  return nearest;
}

std::string did_you_mean(const std::string& typed, const Words& known) {
  const std::string meant = nearest_word(typed, known);
  return meant.empty() ? "" : "; did you mean " + meant + "?";
}

std::string no_such_word(const std::string& typed, const Words& known) {
  return "no " + typed + " among " + joined(known) + did_you_mean(typed, known);
}

std::size_t place_among(const Words& known, const std::string& word, const std::string& option) {
  const auto found = std::ranges::find(known, word);
  if (found == known.end()) throw UsageMistake(option + ": " + no_such_word(word, known));
  return static_cast<std::size_t>(found - known.begin());
}

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
