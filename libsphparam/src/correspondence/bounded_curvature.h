#pragma once

#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// Mean curvature h, averaged over 0.16 R and in units of 3 / R, R the radius of the sphere of the
/// same area, as h / √(1 + h²): bounded, for fingertips would else outweigh everything. #V.
VectorX bounded_curvature(const MappedMesh& mapped, int threads);

}  // namespace sphparam
