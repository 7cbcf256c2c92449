#pragma once

#include <string>
#include <vector>

#include "sphparam/io/polygons.h"

namespace sphparam {

/// Vertices where two polygons and no others meet, between the same two neighbours: these polygons
/// share two edges in a row. Polygons that name a vertex twice do not count. In increasing order.
/// Cost: O(corners).
std::vector<int> find_doublets(const Polygons& polygons, std::int64_t vertex_count);

/// "two polygons share two edges in a row about vertices 17, 23: …". Requires: not empty.
std::string doublet_note(const std::vector<int>& doublets);

}  // namespace sphparam
