#pragma once

#include <algorithm>

#include "mesh/triangle_geometry.h"
#include "sphparam/mesh/fillers.h"
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

inline double face_area(const TriangleMesh& mesh, Face face) {
  const auto corner = [&](int k) { return mesh.position(mesh.triangles(face, k)); };
  return triangle_area(corner(0), corner(1), corner(2));
}

/// Whether any triangle has area, at any size that doubles have. Requires: faces name vertices that
/// are there.
bool has_area(const TriangleMesh& mesh);

/// What a closed mesh encloses, below 0 where its faces look inward, against the cube of the root
/// of its area: 0.094 of a ball, 0.01 of a cortex, next to nothing of a sheet. At any size; no
/// number without area. Requires: a vertex; faces name vertices that are there.
double enclosed(const TriangleMesh& mesh);

/// Of the area of a closed surface, what fillers have of it at most where inside and outside are
/// its own. A sheet is as much filler as surface: which side of it is out, its file says.
constexpr double most_filled = 0.4;

/// Whether fillers have more than that. At any size. Requires: a mark a face, or none at all; faces
/// name vertices that are there.
bool is_sheet(const TriangleMesh& mesh, const FillerMarks& fillers);

}  // namespace sphparam
