#include "reports/told_repairs.h"

#include <algorithm>

#include "io/shell_word.h"
#include "mesh/repair/dropped_cavities.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/io/shape_change.h"
#include "sphparam/io/shared_places.h"
#include "sphparam/words.h"

namespace sphparam::cli {

namespace {

/// How to have what nobody asked to drop; empty where nothing was dropped, or more than specks, and
/// so because it was asked for, or cavities alone, which a wrap fills.
std::string kept_whole_line(const MeshSource& source) {
  const KeptParts& parts = source.parts;
  const bool are_specks = parts.count > 0 && !parts.refused && parts.area_share < 1 &&
                          parts.area_share >= RepairOptions{}.least_kept;
  if (!are_specks || std::ranges::any_of(source.repairs, are_all_cavities)) return "";
  return "`sphparam asset " + shell_file(source.path) + " --keep 1` keeps that too, in a wrap";
}

}  // namespace

void tell_repairs(const MeshSource& source, Console& console) {
  for (const RepairAction& repair : source.repairs) console.say("  " + repair.message);
  if (const std::string lines = handle_lines(source.handles, "    "); !lines.empty())
    console.say(lines.substr(0, lines.size() - 1));
  if (const std::string kept = kept_line(source.parts, source.repairs); !kept.empty())
    console.say("  " + kept);
  if (const std::string whole = kept_whole_line(source); !whole.empty())
    console.say("    " + whole);
  for (const std::string& line :
       {added_line(source), shape_line(source), weld_line(source), shared_places_line(source)})
    if (!line.empty()) console.say("  " + line);
  if (source.repairs.empty()) return;
  if (const std::string hollow = hollow_line(source); !hollow.empty()) console.warning(hollow);
}

}  // namespace sphparam::cli
