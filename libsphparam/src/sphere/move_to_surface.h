#pragma once

#include <cmath>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// λ of the triangle with corners at these distances along its rays, from λ of the rays: of the
/// point where the direction, as a ray, meets it.
inline void move_to_surface(const Vector3& distances, Vector3& weights) {
  const Vector3 moved = weights.cwiseQuotient(distances);
  const double sum = moved.sum();
  if (std::isfinite(sum) && sum > 0) weights = moved / sum;
}

}  // namespace sphparam
