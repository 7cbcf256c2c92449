#pragma once

#include <string>

#include "remesh/sphere_grid.h"

namespace sphparam::cli {

/// The grid of `like:MESH`: the rays sx sy sz of a file, or its vertices about the origin, and its
/// triangles.
/// Throws: ReadError; MeshRefusal; NotCertifiedError where it is no sphere.
SphereGrid read_like_grid(const std::string& path, int threads);

}  // namespace sphparam::cli
