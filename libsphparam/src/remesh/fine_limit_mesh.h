#pragma once

#include <cstdint>

#include "remesh/subdivision_fit.h"

namespace sphparam {

/// Triangles that show a fitted limit surface: its patches cut into `pieces` pieces or more.
/// Requires: `faces` are those the surface was fitted on. Throws: as `tessellate`.
/// Ensures: the same bytes for any number of threads.
TriangleMesh fine_limit_mesh(const SubdivisionFit& fit, const Polygons& faces, std::int64_t pieces,
                             int threads = 0);

}  // namespace sphparam
