#pragma once

#include "remesh/subdivided_grid.h"

namespace sphparam {

/// Triangle faces cut into N² each, on the flat polyhedron: corners first, then edges, then faces,
/// row by row. Points are Σ weights·corner with whole weights that sum to N.
SphereGrid cut_triangles(const Polyhedron& polyhedron, int n);

/// The cube's faces cut into N×N quads, on the flat cube [−N, N]³: whole coordinates.
SphereGrid cut_cube(int n);

/// W meridians and H rows of cells: the north pole, rows of W vertices, the south pole.
SphereGrid cut_longitudes(int width, int height);

}  // namespace sphparam
