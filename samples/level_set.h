#pragma once

#include <functional>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::samples {

/// A shape by a function that is negative inside, and about as steep as the distance.
using Field = std::function<double(const Vector3&)>;

/// Its gradient, by differences over `step`.
Vector3 gradient(const Field& field, const Vector3& point, double step);

/// The surface field = 0 inside the box, by marching tetrahedra on a body-centred cubic lattice
/// with cubes of size `cube`.
///
/// Ensures: a closed, oriented manifold if the field is positive on the box's border.
/// After Chan and Purisima, "A new tetrahedral tesselation scheme for isosurface generation"
/// (1998).
TriangleMesh level_set(const Field& field, const Vector3& low, const Vector3& high, double cube);

}  // namespace sphparam::samples
