#pragma once

#include <vector>

#include "sphparam/mesh/surface_point.h"

namespace sphparam {

/// Where a surface ends: edges that one triangle alone has. Vertices that lie in one place are one
/// there, so that no seam of copies is a border; triangles with two corners in one place have none.
class Border {
 public:
  /// Requires: finite positions; faces name vertices that are there. Cost: O(#F log #F).
  explicit Border(const TriangleMesh& mesh);

  /// Whether a point lies on it: a corner, or on an edge, as weights that are 0 say.
  bool holds(const SurfacePoint& point) const;

 private:
  // Of every face six bits: the edges opposite to corners 0, 1, 2, and these corners.
  std::vector<unsigned char> of_face_;
};

}  // namespace sphparam
