#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// How much of the sky each vertex sees, in [0, 1], weighted by the cosine. #V.
///
/// Visibility is looked up in depth buffers of the mesh from `directions` sides. A mesh that is one
/// point sees all of it. Requires: finite positions, of any size; unit normals.
/// Our own: no ray tracer needed, and the same bits for any number of threads.
Eigen::VectorXf sky_visibility(const TriangleMesh& mesh, const Points& normals,
                               int directions = 128, int threads = 0);

}  // namespace sphparam
