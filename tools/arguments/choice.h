#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "arguments/suggestion.h"

namespace sphparam::cli {

/// An option whose value is one of a few words, which --help shows and shells complete. A wrong
/// word is answered with the right ones.
template <class Value>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Value& value,
                        const std::vector<std::pair<std::string, Value>>& choices,
                        const std::string& description) {
  const auto choose = [&value, choices, name](const std::string& word) {
    std::vector<std::string> words;
    std::string all;
    for (const auto& [known, meaning] : choices) {
      if (word == known) {
        value = meaning;
        return;
      }
      words.push_back(known);
      all += (all.empty() ? "" : ", ") + known;
    }
    const std::string meant = nearest_word(word, words);
    throw CLI::ValidationError(name, "no " + word + " among " + all +
                                         (meant.empty() ? "" : "; did you mean " + meant + "?"));
  };
  std::string all;
  for (const auto& choice : choices) all += (all.empty() ? "" : "|") + choice.first;
  return command.add_option_function<std::string>(name, choose, description)->type_name(all);
}

/// A decimal number between two others, both allowed. (CLI11 takes 010 for 8, and 0x10 for 16.)
template <class Number>
CLI::Validator between(Number least, Number most, const std::string& words) {
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        Number value{};
        const std::string digits = text.substr(text.starts_with('+') ? 1 : 0);
        const char* const end = digits.data() + digits.size();
        const auto [stop, error] = std::from_chars(digits.data(), end, value);
        bool inside = error == std::errc{} && stop == end && value >= least && value <= most;
        if constexpr (std::is_integral_v<Number>) inside &= digits == std::to_string(value);
        return inside ? "" : "expected a number from " + words;
      },
      "");
}

}  // namespace sphparam::cli
