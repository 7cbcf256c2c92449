#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/suggestion.h"

namespace sphparam::tools {

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

/// A number between two others, both allowed.
template <class Number>
CLI::Validator between(Number least, Number most, const std::string& words) {
  return CLI::Validator(
      [=](const std::string& text) -> std::string {
        Number value{};
        const bool inside =
            CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return inside ? "" : "expected a number from " + words;
      },
      "");
}

}  // namespace sphparam::tools
