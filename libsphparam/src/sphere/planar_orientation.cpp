#include "sphere/planar_orientation.h"

#include "sign_filter.h"
#include "sphparam/sphere/orientation.h"

// Shewchuk's first filter (1997, Section 4.3): with δ = 2⁻⁵³ the differences, products and the sum
// are off by less than (3 + 16δ)δ of |left| + |right|; 4δ = 2⁻⁵¹ covers it. Products that may have
// underflowed are left to the exact path: det((v, u, 1), …) in integers.

namespace sphparam {

int planar_orientation(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c) {
  const FilteredSum area =
      filtered_difference((a.v - c.v) * (b.u - c.u), (a.u - c.u) * (b.v - c.v));
  if (area.size > 1e-280) {
    if (const int sign = area.sign(0x1p-51)) return sign;
  }
  return exact_orientation({a.v, a.u, 1}, {b.v, b.u, 1}, {c.v, c.u, 1});
}

}  // namespace sphparam
