#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sphparam/batch/plan.h"

namespace sphparam {

/// A {NAME} in a word.
struct Placeholder {
  std::size_t at, length;
  std::string name;
};

std::vector<Placeholder> placeholders_in(const std::string& word);

/// Is it a placeholder that subcommands themselves have?
bool is_foreign(const std::string& name);

/// A word as it runs for an item; {input} stays unless it is wanted. Throws: BatchInputError.
std::string substituted(const std::string& word, const BatchPlan& plan, const BatchItem& item,
                        bool with_input);

/// The words of the column `options`, where a table has it, come after those of the first step.
void add_options_of_row(std::vector<BatchStep>& steps, const BatchPlan& plan,
                        const BatchItem& item);

/// What steps that are completed leave for the next or as their result, in their folder.
std::vector<std::string> files_left_by(const std::vector<BatchStep>& steps);

/// Words as shells split them, quotes and all but backslashes. Throws: BatchInputError.
std::vector<std::string> words_of(const std::string& text);

}  // namespace sphparam
