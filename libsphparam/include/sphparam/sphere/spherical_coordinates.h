#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The one convention of this project. θ ∈ [0, 2π) is longitude, ϕ ∈ [0, π] the polar angle from
/// the north pole; texture coordinates are u = θ/2π, v = ϕ/π, row 0 north.
struct SphericalCoordinates {
  double theta;  // radians
  double phi;    // radians
};

/// x = cos θ sin ϕ, y = sin θ sin ϕ, z = cos ϕ.  Paper: Section 3.
Vector3 to_cartesian(SphericalCoordinates coordinates);

/// The inverse, for rays of any length. At ±z, θ = 0. Ensures: θ in [0, 2π), ϕ in [0, π].
SphericalCoordinates to_spherical(const Vector3& ray);

}  // namespace sphparam
