#include "arguments/repair_arguments.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <limits>
#include <vector>

#include "arguments/choice.h"
#include "commands/command.h"
#include "sphparam/names.h"
#include "number_text.h"

// --repair is a flag that may carry words after an equals sign, so that it never takes the name of
// the mesh for one of them.

namespace sphparam::cli {

namespace {

constexpr char without_words[] = "true";  // what CLI11 makes of a bare flag

std::vector<std::string> all_words() {
  std::vector<std::string> words;
  for (const RepairSwitch& repair : repair_switches()) words.emplace_back(repair.name);
  return words;
}

void switch_on(RepairOptions& options, const std::string& word) {
  for (const RepairSwitch& repair : repair_switches()) {
    if (word != repair.name) continue;
    options.*repair.wanted = true;
    return;
  }
  const std::string meant = nearest_word(word, all_words());
  throw UsageMistake("--repair: no " + word + " among " + joined(all_words()) +
                     (meant.empty() ? "" : "; did you mean " + meant + "?"));
}

RepairOptions only(const std::string& words) {
  RepairOptions options = RepairOptions::none();
  for (size_t start = 0; start <= words.size();) {
    const size_t end = std::min(words.find(',', start), words.size());
    switch_on(options, words.substr(start, end - start));
    start = end + 1;
  }
  return options;
}

/// "0.5" or "50%": a share from 0 to 1.
std::optional<double> parse_share(std::string text) {
  const bool percent = !text.empty() && text.back() == '%';
  if (percent) text.pop_back();
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (percent) value /= 100;
  const bool good = error == std::errc{} && stop == end && value >= 0 && value <= 1;
  return good ? std::optional(value) : std::nullopt;
}

}  // namespace

void add_repair_options(CLI::App& command, RepairArguments& arguments) {
  const std::string group = "Repairs";
  constexpr int most = std::numeric_limits<int>::max();
  command
      .add_flag("--repair", arguments.words,
                "Mend the mesh first: everything, or as in --repair=holes,unused some of " +
                    joined(all_words()))
      ->group(group);
  command
      .add_option("--component", arguments.component,
                  "Keep the N-th largest component by area, whatever its share")
      ->check(between(1, most, "1 on"))
      ->type_name("N")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--min-kept",
          [&arguments](const std::string& text) {
            arguments.least_kept = parse_share(text);
            if (arguments.least_kept) return;
            throw CLI::ValidationError("--min-kept", "expected a share, as in 0.5 or 50%");
          },
          "Keep the largest component if it has this share of the area; else exit with status 4 "
          "(--repair: 98%)")
      ->type_name("SHARE")
      ->group(group);
  command
      .add_option("--max-hole", arguments.largest_hole,
                  "Fill holes of at most so many edges (--repair: " +
                      std::to_string(RepairOptions{}.largest_hole) + ")")
      ->check(between(3, most, "3 on"))
      ->type_name("EDGES")
      ->group(group);
}

std::optional<RepairOptions> wanted_repairs(const RepairArguments& arguments) {
  const bool chosen = arguments.component > 0 || arguments.least_kept;
  if (arguments.words.empty() && !chosen && !arguments.largest_hole) return std::nullopt;
  if (arguments.component && arguments.least_kept) {
    throw UsageMistake(
        "--component and --min-kept contradict each other: a component that is named is kept "
        "whatever its share");
  }
  RepairOptions options = arguments.words == without_words ? RepairOptions{}
                          : arguments.words.empty()        ? RepairOptions::none()
                                                           : only(arguments.words);
  if (chosen) options.components = true;
  options.component = arguments.component;
  options.least_kept = arguments.least_kept.value_or(options.least_kept);
  if (arguments.largest_hole) {
    options.holes = true;
    options.largest_hole = arguments.largest_hole;
  }
  // What other repairs leave without faces must not stand in the way of the map.
  options.unused = true;
  return options;
}

}  // namespace sphparam::cli
