#include "reports/told_repairs.h"

#include "sphparam/words.h"

namespace sphparam::cli {

void tell_repairs(const MeshSource& source, Console& console) {
  for (const RepairAction& repair : source.repairs) console.say("  " + repair.message);
  if (const std::string lines = handle_lines(source.handles, "    "); !lines.empty())
    console.say(lines.substr(0, lines.size() - 1));
  if (const std::string kept = kept_line(source.parts); !kept.empty()) console.say("  " + kept);
}

}  // namespace sphparam::cli
