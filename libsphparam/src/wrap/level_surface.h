#pragma once

#include <vector>

#include "wrap/solid.h"

namespace sphparam {

/// The surface of a solid: where the values are 0, linear along the edges of the lattice from a
/// point of it to one that is not; in the middle of edges along which they do not change sign. No
/// vertex is nearer to a point of the lattice than a twentieth of the edge, so that no triangle is
/// flat. Ensures: closed, manifold, outward, without self-intersections. Throws: std::length_error
/// where there are more corners than ints. Cost: linear in the lattice, one thread.
TriangleMesh level_surface(const Lattice& lattice, const std::vector<float>& field,
                           const Solid& solid);

}  // namespace sphparam
