#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "number_text.h"

namespace sphparam::cli {

using Words = std::vector<std::string>;

/// "a", "b", "c" of "a,b,c".
Words split(const std::string& text);

/// The same of several texts, one after the other, without empty words.
Words split_all(const Words& texts);

/// x, y and z of "1,-2.5,3"; nothing for anything else, also for what is not finite.
std::optional<std::array<double, 3>> three_numbers(const std::string& text);

/// NAME and FILE of "NAME=FILE"; nothing where a part is missing.
std::optional<std::pair<std::string, std::string>> name_and_file(const std::string& text);

/// The known word nearest to a mistyped one, or "" when none is near enough to be meant.
std::string nearest_word(const std::string& typed, const Words& known);

/// "; did you mean WORD?", or "".
std::string did_you_mean(const std::string& typed, const Words& known);

/// "no WORD among a, b, c; did you mean a?"
std::string no_such_word(const std::string& typed, const Words& known);

/// Where a word stands among those that are known.
/// Throws: UsageMistake that begins with the option.
std::size_t place_among(const Words& known, const std::string& word, const std::string& option);

/// Of a row of things the names.
template <class Things, class Name>
Words names_of(const Things& things, Name name) {
  Words names;
  for (const auto& thing : things) names.emplace_back(std::invoke(name, thing));
  return names;
}

}  // namespace sphparam::cli
