#pragma once

#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/mesh/surface_point.h"
#include "sphparam/remesh/resample.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

/// Means over the faces of a grid where they are larger than those of the source: each takes from
/// the source's faces whose middles lie in it, but for fillers, by their areas on the source; one
/// that holds a single middle or none takes from the face that its own middle lies in. `vertices`
/// of the result are faces of the source, a sample a face of the grid.
/// Requires: `middles` are the places of the middles of the grid's faces.
/// Ensures: the same bytes for any number of threads. Cost: as locating the source's faces.
Gather gather_faces(const MappedMesh& source, const SphereGrid& grid,
                    const std::vector<SurfacePoint>& middles, int threads = 0);

}  // namespace sphparam
