#pragma once

#include "mesh/box.h"

namespace sphparam {

/// Whether the faces of a closed mesh look inward: what they enclose is less than nothing, by more
/// than rounding. Of any size. Requires: a vertex. Cost: a pass over the faces.
inline bool is_inside_out(const TriangleMesh& mesh) {
  const double side = longest_side(mesh);
  const Vector3 origin = mesh.position(0);
  double volume = 0;  // of a mesh of length 1, sixfold
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) {
      return Vector3((mesh.position(mesh.triangles(f, k)) - origin) / side);
    };
    volume += corner(0).dot(corner(1).cross(corner(2)));
  }
  constexpr double rounding = 1e-9;
  return volume < -rounding;
}

}  // namespace sphparam
