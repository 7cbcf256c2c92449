#include "sphere/planar_orientation.h"

#include <cmath>

#include "ieee_arithmetic.h"
#include "sphparam/sphere/orientation.h"

// Shewchuk's first filter (1997, Section 4.3): with δ = 2⁻⁵³ the differences, products and the sum
// are off by less than (3 + 16δ)δ of |left| + |right|; 4δ = 2⁻⁵¹ covers it. Products that may have
// underflowed are left to the exact path: det((v, u, 1), …) in integers.

namespace sphparam {

int planar_orientation(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c) {
  const double left = (a.v - c.v) * (b.u - c.u), right = (a.u - c.u) * (b.v - c.v);
  const double area = left - right, magnitude = std::abs(left) + std::abs(right);
  if (magnitude > 1e-280) {
    const double bound = 0x1p-51 * magnitude;
    if (area > bound) return 1;
    if (-area > bound) return -1;
  }
  return exact_orientation({a.v, a.u, 1}, {b.v, b.u, 1}, {c.v, c.u, 1});
}

}  // namespace sphparam
