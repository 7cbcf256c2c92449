#include "arguments/repair_arguments.h"

#include <cmath>

#include "console/exit_codes.h"
#include "number_text.h"
#include "sphparam/io/loop_file.h"
#include "sphparam/names.h"
#include "sphparam/parameterize.h"

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

/// "12.5", a length, or "40%" of the diagonal.
bool read_length(const std::string& text, std::optional<Amount>& longest) {
  longest = amount_of(text);
  return longest && std::isfinite(longest->value) && longest->value > 0;
}

/// "0.01", a length, or "0.1%" of the diagonal; 0 is what lies at one place.
bool read_weld(const std::string& text, std::optional<Amount>& weld) {
  weld = amount_of(text);
  return weld && std::isfinite(weld->value) && weld->value >= 0;
}

void settle_weld(const RepairArguments& arguments, RepairOptions& options) {
  if (!arguments.weld) return;
  options.cracks = true;
  (arguments.weld->percent ? options.weld_share : options.weld_length) = arguments.weld->of(1);
}

void settle_edges(const RepairArguments& arguments, RepairOptions& options) {
  const std::optional<Amount>& longest = arguments.longest_edge;
  if (longest) (longest->percent ? options.edge_share : options.edge_length) = longest->of(1);
}

void settle_handles(const RepairArguments& arguments, RepairOptions& options) {
  if (arguments.given("--handles") || arguments.longest_handle) options.handles = true;
  options.handle_choice = arguments.handle_choice;
  if (arguments.longest_handle && arguments.longest_handle->percent) {
    options.longest_handle = arguments.longest_handle->of(1);
  } else if (arguments.longest_handle) {
    options.longest_handle_length = arguments.longest_handle->value;
  }
}

std::string typed(const Amount& amount) {
  return shortest(amount.value) + (amount.percent ? "%" : "");
}

/// "", " --repair" or " --repair=holes".
std::string typed_flag(const std::string& option, const std::string& words) {
  if (words.empty()) return "";
  return " " + option + (words == without_words ? "" : "=" + words);
}

void require_sensible_loops(const RepairArguments& arguments, bool wanted) {
  if (arguments.loops.empty()) return;
  if (!wanted) throw UsageMistake("--loops is for --repair, or --repair=handles");
  if (!is_loop_file(arguments.loops)) {
    throw UsageMistake("--loops: the name must end in .obj or .ply");
  }
}

}  // namespace

void declare_repair_options(Declaration& command, RepairArguments& arguments) {
  arguments.given = command.given();
  const auto longest = [&](const std::string& text) {
    return read_length(text, arguments.longest_handle);
  };
  const auto edge = [&](const std::string& text) {
    return read_length(text, arguments.longest_edge);
  };
  const auto weld = [&](const std::string& text) { return read_weld(text, arguments.weld); };
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
      .parsed("--weld", "LENGTH", weld, "expected a length, as in 0.01 or 0.1%",
              "Weld boundary vertices that are at most so far apart, and split boundary edges at "
              "vertices that lie so near; % is of the bounding box's diagonal")
      .flag("--keep-holes", arguments.keep_holes,
            "Holes of any length stay holes: what closes them is marked, and left out by all "
            "subcommands; at most 2% of the sphere goes to it, or as in --keep-holes=10%")
      .choice("--handles", arguments.handle_choice,
              {{name_of(HandleChoice::Shortest), HandleChoice::Shortest},
               {name_of(HandleChoice::Cut), HandleChoice::Cut},
               {name_of(HandleChoice::Fill), HandleChoice::Fill},
               {name_of(HandleChoice::Area), HandleChoice::Area}},
              "Cut handles through, fill what goes through them, or whichever is shorter, or adds "
              "less area (default: shortest)")
      .parsed("--max-handle", "LENGTH", longest, "expected a length, as in 12.5 or 40%",
              "Remove handles along loops of at most this length; % is of the diagonal of its "
              "part's bounding box (--repair: " +
                  short_number(100 * RepairOptions{}.longest_handle) + "%)")
      .parsed("--max-edge", "LENGTH", edge, "expected a length, as in 12.5 or 1%",
              "At last halve edges that are longer, until none is: a map bends within large flat "
              "faces then, not at their sides; % is of the bounding box's diagonal")
      .group("Options");
}

void declare_repair_and_loops(Declaration& command, RepairArguments& arguments) {
  declare_repair_options(command, arguments);
  command.group("Repairs")
      .text("--loops", arguments.loops, "FILE", "These loops as polylines, an .obj or .ply")
      .written()
      .group("Options");
}

std::optional<RepairOptions> wanted_repairs(const RepairArguments& arguments) {
  const bool chosen = arguments.component > 0 || arguments.least_kept;
  if (arguments.words.empty() && !chosen && !arguments.largest_hole &&
      arguments.keep_holes.empty() && !arguments.longest_handle && !arguments.weld &&
      !arguments.longest_edge && !arguments.given("--handles")) {
    require_sensible_loops(arguments, false);
    return std::nullopt;
  }
  if (arguments.component && arguments.least_kept) {
    throw UsageMistake(
        "--component and --min-kept contradict each other: a component that is named is kept "
        "whatever its share");
  }
  if (arguments.largest_hole && !arguments.keep_holes.empty()) {
    throw UsageMistake(
        "--max-hole and --keep-holes contradict each other: a hole is filled, or it is kept");
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
  settle_weld(arguments, options);
  settle_edges(arguments, options);
  if (!arguments.keep_holes.empty()) options.holes = options.keep_holes = true;
  settle_handles(arguments, options);
  require_sensible_loops(arguments, options.handles);
  // What other repairs leave without faces must not stand in the way of the map.
  options.unused = true;
  return options;
}

RepairOptions all_or_wanted_repairs(RepairArguments arguments) {
  if (arguments.words.empty()) arguments.words = without_words;
  return wanted_repairs(arguments).value();
}

double wanted_filler_share(const RepairArguments& arguments) {
  if (arguments.keep_holes.empty() || arguments.keep_holes == without_words) {
    return ParameterizeOptions{}.filler_share;
  }
  std::optional<double> share;
  if (read_share(arguments.keep_holes, share) && *share > 0) return *share;
  throw UsageMistake("--keep-holes: expected a share of the sphere, as in 0.1 or 10%, not " +
                     arguments.keep_holes);
}

std::string typed_again(const RepairArguments& a) {
  std::string line = typed_flag("--repair", a.words);
  if (a.component > 0) line += " --component " + std::to_string(a.component);
  if (a.least_kept) line += " --min-kept " + shortest(*a.least_kept);
  if (a.largest_hole > 0) line += " --max-hole " + std::to_string(a.largest_hole);
  if (a.weld) line += " --weld " + typed(*a.weld);
  line += typed_flag("--keep-holes", a.keep_holes);
  if (a.given("--handles")) line += " --handles " + name_of(a.handle_choice);
  if (a.longest_handle) line += " --max-handle " + typed(*a.longest_handle);
  if (a.longest_edge) line += " --max-edge " + typed(*a.longest_edge);
  return line;
}

}  // namespace sphparam::cli
