#pragma once

#include "remesh/resampling.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// `vertex_areas`, of the mesh at about unit size where squares of its own would be no numbers.
VectorX relative_areas(const TriangleMesh& mesh);

/// Means over the cells of a grid where it is coarser than the source: every vertex of the source
/// gives to the corners of the grid triangle that it lies in, by barycentric weight times its own
/// area on the source surface, so that nothing is left out, however small. A grid vertex that gets
/// from three source vertices or fewer has no entries: a point sample sees as much.
/// Source: "adaptive barycentric" resampling of surface data with vertex areas, of the Connectome
/// Workbench (Glasser et al. 2013).
/// Ensures: the same bytes for any number of threads. Cost: as locating the source's vertices.
Gather gather_cells(const TriangleMesh& source, const SphereMap& map, const Topology& grid,
                    const SphereMap& grid_map, int threads = 0);

}  // namespace sphparam
