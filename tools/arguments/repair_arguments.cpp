#include "arguments/repair_arguments.h"

#include "console/exit_codes.h"
#include "sphparam/names.h"

// --repair is a flag that may carry words after an equals sign, so that it never takes the name of
// the mesh for one of them.

namespace sphparam::cli {

namespace {

constexpr char without_words[] = "true";  // what CLI11 makes of a bare flag

Words all_words() { return names_of(repair_switches(), &RepairSwitch::name); }

RepairOptions only(const std::string& words) {
  RepairOptions options = RepairOptions::none();
  for (const std::string& word : split(words))
    options.*repair_switches()[place_among(all_words(), word, "--repair")].wanted = true;
  return options;
}

/// "0.5" or "50%": a share from 0 to 1.
bool read_share(const std::string& text, std::optional<double>& share) {
  const std::optional<Amount> amount = amount_of(text);
  if (amount) share = amount->of(1);
  return amount && *share >= 0 && *share <= 1;
}

}  // namespace

void declare_repair_options(Declaration& command, RepairArguments& arguments) {
  const auto read = [&](const std::string& text) { return read_share(text, arguments.least_kept); };
  command.group("Repairs")
      .flag("--repair", arguments.words,
            "Mend the mesh first: everything, or as in --repair=holes,unused some of " +
                joined(all_words()))
      .number("--component", arguments.component, "N", {1},
              "Keep the N-th largest component by area, whatever its share")
      .parsed("--min-kept", "SHARE", read, "expected a share, as in 0.5 or 50%",
              "Keep the largest component if it has this share of the area; else exit with status "
              "4 (--repair: 98%)")
      .number("--max-hole", arguments.largest_hole, "EDGES", {3},
              "Fill holes of at most so many edges (--repair: " +
                  std::to_string(RepairOptions{}.largest_hole) + ")")
      .group("Options");
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
