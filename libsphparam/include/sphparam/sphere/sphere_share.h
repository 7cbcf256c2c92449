#pragma once

#include "sphparam/mesh/fillers.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// The share of the sphere that marked triangles take, 0 to 1.
/// Requires: a mark a triangle, or none at all; one finite unit ray a vertex. Ensures: the same
/// bits for any number of threads. Cost: one pass.
double sphere_share(const Triangles& triangles, const SphereMap& map, const FillerMarks& marked);

}  // namespace sphparam
