#pragma once

#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

/// All triangulations of the sphere with a given number of vertices, one of each combinatorial type
/// (mirror images count as one): 1, 1, 2, 5, 14, 50, 233, 1249, 7595, 49566 for 4 to 13 vertices,
/// OEIS A000109.
namespace sphparam::tests {

/// The neighbours of each vertex, counter-clockwise.
using Rotations = std::vector<std::vector<int>>;

/// Found by flipping edges, from the double pyramid on. Requires: 4 to 200 vertices.
/// Cost: some 10 µs for every flip of every type; 13 vertices take half a minute.
std::vector<Rotations> all_triangulations(int vertices);

/// A mesh of that connectivity with random positions in [−1, 1]³.
TriangleMesh mesh_of(const Rotations& rotations, unsigned seed);

}  // namespace sphparam::tests
