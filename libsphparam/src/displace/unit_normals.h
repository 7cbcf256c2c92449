#pragma once

#include "remesh/subdivision/limit_polynomial.h"

namespace sphparam {

/// Of some points of a limit surface, as LimitPoint::normal has it, but for rounding.
template <int W>
SPHPARAM_INLINE LaneVectors<W> unit_normals(const LimitLanes<W>& points) {
  const LaneVectors<W> across = cross(points.by_s, points.by_t);
  const Lanes<W> length = root(dot(across, across)), none = 0.0;
  const LaneMask<W> has_normal = length > 0.0;
  return {select(has_normal, across.x / length, none), select(has_normal, across.y / length, none),
          select(has_normal, across.z / length, none)};
}

}  // namespace sphparam
