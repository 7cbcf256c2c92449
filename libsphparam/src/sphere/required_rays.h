#pragma once

#include <stdexcept>
#include <string>

#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Throws std::invalid_argument, which names the function, unless a map has one ray a vertex.
inline void require_rays(const char* function, const SphereMap& map, Eigen::Index vertices) {
  if (map.points.rows() == vertices) return;
  throw std::invalid_argument(std::string(function) + ": the map has " +
                              std::to_string(map.points.rows()) + " rays, and the mesh " +
                              std::to_string(vertices) + " vertices");
}

}  // namespace sphparam
