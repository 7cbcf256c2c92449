#pragma once

#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// The Möbius transformation of the sphere that moves along the axis a, |a| < 1, and takes a to the
/// centre where it acts on the ball: 0 is the identity.
Vector3 mobius_translated(const Vector3& x, const Vector3& a);

/// The map after the Möbius transformation (no rotation) that puts Σ mass·x near 0.
///
/// Newton's method on the centre, by repeated translation. Ensures: |Σ mass·x| ≤ 1e-10·Σ mass, if a
/// centre exists (no point has half of the mass) and `max_steps` suffice; unit rays.
/// Paper: Baden, Crane, Kazhdan, "Möbius registration" (2018), Algorithm 1.
SphereMap mobius_centred(SphereMap map, const VectorX& mass, int max_steps = 60, int threads = 0);

/// A third of the area of the triangles at each vertex; the sum is 1. Shapes: #V.
VectorX vertex_masses(const TriangleMesh& mesh);

}  // namespace sphparam
