#pragma once

#include <functional>
#include <optional>
#include <string>

#include "arguments/declaration.h"
#include "sphparam/mesh/mesh_repair.h"

namespace sphparam::cli {

/// What the command line says about repairs.
struct RepairArguments {
  std::string words;  // of --repair: empty when it was not given, "true" when it was without words
  int component = 0;  // 0: not given
  std::optional<double> least_kept;
  int largest_hole = 0;
  std::string keep_holes;  // empty: not given, "true" when it was without a share
  HandleChoice handle_choice = HandleChoice::Shortest;
  std::optional<Amount> longest_handle, weld, longest_edge;
  std::string loops;  // empty: not wanted
  /// Was this option on the command line?
  std::function<bool(const std::string&)> given = [](const std::string&) { return false; };
};

/// --repair[=WORD,…], --component N, --min-kept SHARE, --max-hole N, --keep-holes[=SHARE],
/// --handles WORD, --max-handle LENGTH, --weld LENGTH and --max-edge LENGTH.
void declare_repair_options(Declaration& command, RepairArguments& arguments);

/// The same, and --loops FILE, where the mended mesh is what is written.
void declare_repair_and_loops(Declaration& command, RepairArguments& arguments);

/// What is wanted, or nothing. --repair alone wants everything; --component, --min-kept,
/// --max-hole, --keep-holes, --handles, --max-handle, --weld and --max-edge want their own repair
/// also without it.
/// Throws: UsageMistake for a word that is none, for --component with --min-kept, or for --loops
///         where handles are not wanted, or of no format.
std::optional<RepairOptions> wanted_repairs(const RepairArguments& arguments);

/// The same where a repair is what the subcommand is for: everything, unless --repair names some.
RepairOptions all_or_wanted_repairs(RepairArguments arguments);

/// The share of the sphere that fillers may take, as --keep-holes says. Throws: UsageMistake.
double wanted_filler_share(const RepairArguments& arguments);

/// What was given of these, to be typed again: " --repair=holes --max-hole 12"; empty: nothing.
std::string typed_again(const RepairArguments& arguments);

}  // namespace sphparam::cli
