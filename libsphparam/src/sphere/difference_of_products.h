#pragma once

#include <cmath>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// ab − cd, to one and a half units in the last place.  Kahan's; proof: Jeannerod et al. 2013.
inline double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  const double error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

/// a×b, each entry as near, however much cancels.
inline Vector3 near_cross(const Vector3& a, const Vector3& b) {
  return {difference_of_products(a.y(), b.z(), a.z(), b.y()),
          difference_of_products(a.z(), b.x(), a.x(), b.z()),
          difference_of_products(a.x(), b.y(), a.y(), b.x())};
}

}  // namespace sphparam
