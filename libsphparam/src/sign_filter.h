#pragma once

#include <cmath>

#include "ieee_arithmetic.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

// Shewchuk's first filters, "Adaptive precision floating-point arithmetic" (1997): a sum of
// products as it is computed, and the sum of their sizes, of which its rounding error is at most a
// share. How large a share, and from what size on, is proved where a sign is asked for.

struct FilteredSum {
  double value, size;

  /// Its sign, which an error of at most this share of the size cannot have changed; 0: it is open.
  int sign(double share) const {
    const double bound = share * size;
    return value > bound ? 1 : -value > bound ? -1 : 0;
  }
};

/// left − right, two products.
inline FilteredSum filtered_difference(double left, double right) {
  return {left - right, std::abs(left) + std::abs(right)};
}

/// det(a, b, c), and its permanent.
inline FilteredSum filtered_determinant(const Vector3& a, const Vector3& b, const Vector3& c) {
  const FilteredSum x = filtered_difference(b[1] * c[2], b[2] * c[1]),
                    y = filtered_difference(b[2] * c[0], b[0] * c[2]),
                    z = filtered_difference(b[0] * c[1], b[1] * c[0]);
  return {a[0] * x.value + a[1] * y.value + a[2] * z.value,
          std::abs(a[0]) * x.size + std::abs(a[1]) * y.size + std::abs(a[2]) * z.size};
}

}  // namespace sphparam
