#pragma once

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
};

/// --repair[=WORD,…], --component N, --min-kept SHARE and --max-hole N.
void declare_repair_options(Declaration& command, RepairArguments& arguments);

/// What is wanted, or nothing. --repair alone wants everything; --component, --min-kept and
/// --max-hole want their own repair also without it.
/// Throws: UsageMistake for a word that is none, or for --component with --min-kept.
std::optional<RepairOptions> wanted_repairs(const RepairArguments& arguments);

}  // namespace sphparam::cli
