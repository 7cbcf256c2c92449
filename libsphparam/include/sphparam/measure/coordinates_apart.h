#pragma once

#include <optional>

#include "sphparam/measure/surface_distance.h"

namespace sphparam {

/// Two units of length that the coordinates of one body seem to be in.
struct UnitsApart {
  Side smaller = Side::Second;
  double ratio = 1;        // so many times
  const char* units = "";  // "mm and m"
};

/// Is this one body in two units? Where one box is 10, 25.4, 100 or 1000 times as large as the
/// other, within a quarter, and of the same proportions; a part of a whole, or another body, rarely
/// is. Requires: faces name vertices that are there. Cost: one pass.
std::optional<UnitsApart> units_apart(const TriangleMesh& first, const TriangleMesh& second);

/// Are these two systems of coordinates, as a global shift makes them? The distance of the boxes,
/// where it is more than the diagonal of either; else 0. Requires, cost: likewise.
double far_apart(const TriangleMesh& first, const TriangleMesh& second);

}  // namespace sphparam
