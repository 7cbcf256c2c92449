#pragma once

#include <array>

#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/orientation.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Where a map has the corners of a triangle.
inline std::array<Vector3, 3> face_rays(const Topology& topology, const SphereMap& map, Face f) {
  return {map.point(topology.vertex(f, 0)), map.point(topology.vertex(f, 1)),
          map.point(topology.vertex(f, 2))};
}

/// Whether they are counter-clockwise seen from outside (1), clockwise (−1), or in a plane with the
/// centre (0). Exact.
inline int face_orientation(const Topology& topology, const SphereMap& map, Face f) {
  const auto [a, b, c] = face_rays(topology, map, f);
  return orientation(a, b, c);
}

}  // namespace sphparam
