#pragma once

#include "remesh/grids/polyhedron.h"

namespace sphparam {

/// Triangle faces cut into N² each, on the flat polyhedron: corners first, then edges, then faces,
/// row by row. Points are Σ weights·corner with whole weights that sum to N.
SphereGrid cut_triangles(const Polyhedron& polyhedron, int n);

/// The cube's faces cut into N×N quads, on the flat cube [−N, N]³: whole coordinates.
SphereGrid cut_cube(int n);

}  // namespace sphparam
