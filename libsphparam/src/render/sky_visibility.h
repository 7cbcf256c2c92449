#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

inline constexpr int most_sky_cells = 384;

/// How much of the sky each vertex sees, in [0, 1], weighted by the cosine. #V.
///
/// Visibility is looked up in depth buffers of cells² of the mesh from `directions` sides. A mesh
/// that is one point sees all of it. Requires: finite positions, of any size; unit normals.
/// Our own: no ray tracer needed, and the same bits for any number of threads.
Eigen::VectorXf sky_visibility(const TriangleMesh& mesh, const Points& normals,
                               int directions = 128, int cells = most_sky_cells, int threads = 0);

/// As many cells as a picture has pixels a side show what can be seen in it; more than the default
/// show no more at any size.
int sky_cells_for(int pixels);

}  // namespace sphparam
