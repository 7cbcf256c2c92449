#pragma once

#include <string>
#include <vector>

#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/wrap/wrap.h"

namespace sphparam {

// What stood in an asset's way and what was done about it, for who made it: no ids, no lattices.
// The lines with all figures are among the details.

/// "it is open: 83 holes or borders". `found`: of the mesh that has the defect.
std::string plain_words(const MeshDefect& defect, const MeshInspection& found);

/// "12 holes filled": the action without its places.
std::string plain_words(const RepairAction& action);

/// "a skin is drawn around it, 0.5 % of its size away", and what that closed. `size`: the longest
/// side of the asset's box.
std::vector<std::string> plain_words(const Wrap& wrap, double size);

}  // namespace sphparam
