#pragma once

#include <vector>

#include "sphparam/progress.h"
#include "wrap/lattice.h"

namespace sphparam {

/// How much farther than `distance` each point of the lattice is from the soup, in voxels. Exact,
/// but where neither the point nor a neighbour of it is near that distance: outside it is
/// interpolated there, and never less than 0; inside it is anything less than 0. Cost: a nearest
/// point for each so near, about 2 µs, and for each block of those that are not.
std::vector<float> distance_field(const TriangleMesh& soup, const Lattice& lattice, double distance,
                                  int threads, const Progress& progress);

}  // namespace sphparam
