#pragma once

#include <vector>

#include "chart/sheet.h"

namespace sphparam {

/// Moves vertices of a sheet, all at once, until the faces at them are as high as `wanted`, or no
/// step makes them higher: where so many crowd that single ones find no room.
/// Requires: none of the vertices at ±z, all faces at them positive. Ensures: they still are.
/// Cost: a sparse factorisation a step, ten or so.
void spread(Sheet& sheet, const std::vector<Vertex>& vertices, double wanted);

}  // namespace sphparam
