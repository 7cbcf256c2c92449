#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tools {

/// Unit normals, the mean of the faces' weighted by area; +z where that is zero. #V×3.
Points vertex_normals(const TriangleMesh& mesh);

/// How much of the sky each vertex sees, in [0, 1], weighted by the cosine. #V.
///
/// Visibility is looked up in depth buffers of the mesh from `directions` sides.
/// Our own: no ray tracer needed, and the same bits for any number of threads.
Eigen::VectorXf sky_visibility(const TriangleMesh& mesh, const Points& normals,
                               int directions = 128, int threads = 0);

}  // namespace sphparam::tools
