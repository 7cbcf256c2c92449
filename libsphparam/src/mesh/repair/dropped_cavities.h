#pragma once

#include <string>

#include "sphparam/mesh/mesh_repair.h"

namespace sphparam {

/// What of the components that were dropped were cavities of the one that was kept.
struct DroppedCavities {
  long count = 0;
  double volume = 0, share = 0;  // theirs; of what that encloses
};

/// "6 components dropped, all of them cavities within what was kept (volume 93.2, 0.307 % of it):
/// with vertices …", of an action of that kind.
std::string with_cavities(const RepairAction& action, const DroppedCavities& cavities);

/// Whether the message says so of all of them.
bool are_all_cavities(const RepairAction& action);

}  // namespace sphparam
