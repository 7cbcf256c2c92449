#pragma once

#include <vector>

#include "chart/sheet.h"

namespace sphparam {

/// Moves vertices of a sheet, all at once, until the faces at them, folded or not, are as high as
/// `wanted`, or no step helps: where the chord of a long edge is further from its geodesic than
/// the faces beside it are high, all that lies there moves with the chord.
/// Requires: none of the vertices at ±z. Ensures: less is lacking, in the mean of squares; single
/// faces may fold that did not. Cost: a sparse factorisation a step, some dozens.
void unbend(Sheet& sheet, const std::vector<Vertex>& vertices, double wanted);

}  // namespace sphparam
