#include "mesh/repair/dropped_cavities.h"

#include "number_text.h"

namespace sphparam {
namespace {

constexpr const char *all_of_them = " dropped, all of them cavities",
                     *the_one = " dropped, a cavity";

std::string which(long dropped, long cavities) {
  if (dropped == 1) return the_one;
  if (dropped == cavities) return all_of_them;
  return " dropped, " + std::to_string(cavities) + " of them " +
         (cavities == 1 ? "a cavity" : "cavities");
}

}  // namespace

std::string with_cavities(const RepairAction& action, const DroppedCavities& cavities) {
  if (cavities.count == 0) return action.message;
  const std::string places = action.message.substr(action.message.rfind(": "));
  return counted(action.count, "component") + which(action.count, cavities.count) +
         " within what was kept (volume " + short_number(cavities.volume) + ", " +
         percent(cavities.share) + " of it)" + places;
}

bool are_all_cavities(const RepairAction& action) {
  return action.kind == RepairKind::ComponentDropped &&
         (action.message.find(all_of_them) != std::string::npos ||
          action.message.find(the_one) != std::string::npos);
}

}  // namespace sphparam
