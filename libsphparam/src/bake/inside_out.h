#pragma once

#include "mesh/flat_face.h"

namespace sphparam {

/// Whether the faces of a closed mesh look inward: what they enclose is less than nothing, by more
/// than rounding. Of any size. Requires: a vertex. Cost: a pass over the faces.
inline bool is_inside_out(const TriangleMesh& mesh) {
  constexpr double rounding = 1e-9;
  return enclosed(mesh) < -rounding;
}

}  // namespace sphparam
