#pragma once

#include <algorithm>

#include "mesh/triangle_geometry.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A face is flat when its area is below this times the square of its longest edge: the double
/// computation of the area is then nothing but rounding.
constexpr double flat_area = 1e-14;

/// Whether a triangle has no area. Requires: squares of its sides neither overflow nor vanish.
inline bool is_flat(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return triangle_area(a, b, c) <= flat_area * longest;
}

/// The same at any size that doubles have, wherever it lies: sides are taken of the coordinates as
/// they are, for those of a box about the mesh are rounded to what the whole mesh is.
bool has_no_area(const Vector3& a, const Vector3& b, const Vector3& c);

/// Whether any triangle has area, at any size that doubles have. Requires: faces name vertices that
/// are there.
bool has_area(const TriangleMesh& mesh);

}  // namespace sphparam
