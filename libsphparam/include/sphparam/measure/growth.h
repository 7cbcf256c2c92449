#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// How areas grow from one surface to another of the same triangles: shapes of a group, one subject
/// at two times on one grid, a surface and what `carried_shape` makes of it. Above 1: they grew.
struct Growth {
  VectorX faces;     // #F: the second's area over the first's
  VectorX vertices;  // #V: the same of all triangles about a vertex together
  double total = 1;  // of the whole surfaces
};

/// Requires: vertices that are there. Ensures: finite numbers; 0 where the first has no area, or so
/// little that doubles do not hold the ratio. Throws: std::invalid_argument unless both have the
/// same triangles. Cost: linear.
Growth measure_growth(const TriangleMesh& first, const TriangleMesh& second);

}  // namespace sphparam
