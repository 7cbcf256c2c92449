#pragma once

#include "sphparam/io/mapped_mesh.h"

namespace sphparam {

/// How far apart the surfaces of two meshes are that should share a sphere: the distance of their
/// points of the same direction, its median at the vertices of `low` or at directions spread evenly
/// over the sphere, whichever is less, of the diagonal of the box about `high`.
///
/// A mesh made on the other's sphere has its vertices on the other's surface or, as a fitted one,
/// its faces near it; one with a map of its own has neither. 0 where `high` is but a point.
/// Our own. Cost: some 0.2 µs a vertex and direction, and the locators of the two.
double disagreement(const MappedMesh& high, const MappedMesh& low, int threads);

/// Measured on 7 shapes: grids of 162 to 10,242 vertices, and limit surfaces fitted on them, are
/// below 0.012; the same shapes mapped anew, or with another λ, above 0.045.
constexpr double doubtful_disagreement = 0.015, other_sphere_disagreement = 0.03;

}  // namespace sphparam
