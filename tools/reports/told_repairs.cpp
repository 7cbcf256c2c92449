#include "reports/told_repairs.h"

#include "sphparam/io/repair_advice.h"
#include "sphparam/words.h"

namespace sphparam::cli {

void tell_repairs(const MeshSource& source, Console& console) {
  for (const RepairAction& repair : source.repairs) console.say("  " + repair.message);
  if (const std::string lines = handle_lines(source.handles, "    "); !lines.empty())
    console.say(lines.substr(0, lines.size() - 1));
  if (const std::string kept = kept_line(source.parts); !kept.empty()) console.say("  " + kept);
  if (const std::string added = added_line(source); !added.empty()) console.say("  " + added);
}

}  // namespace sphparam::cli
