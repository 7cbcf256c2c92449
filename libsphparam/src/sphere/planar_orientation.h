#pragma once

#include "sign_filter.h"

// Shewchuk's first filter (1997, Section 4.3): with δ = 2⁻⁵³ the differences, products and the sum
// are off by less than (3 + 16δ)δ of |left| + |right|; 4δ = 2⁻⁵¹ covers it. Products that may have
// underflowed are left to the exact path: det((v, u, 1), …) in integers.

namespace sphparam {

/// A point of the (u, v) rectangle.
struct ChartPoint {
  double u, v;
};

/// The sign of `planar_orientation`, in integers.
int exact_planar_orientation(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c);

/// Exact sign of the area of a triangle in the (u, v) plane: +1 when it runs as a face that is
/// counter-clockwise on the sphere. v points south, so that is counter-clockwise in (v, u).
/// Requires: finite entries, |entry| ≤ 2⁶⁴. Cost: about 2 ns; some µs on the exact path.
inline int planar_orientation(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c) {
  const FilteredSum area =
      filtered_difference((a.v - c.v) * (b.u - c.u), (a.u - c.u) * (b.v - c.v));
  if (area.size > 1e-280) {
    if (const int sign = area.sign(0x1p-51)) return sign;
  }
  return exact_planar_orientation(a, b, c);
}

/// Twice that area, in floating point.
inline double planar_area(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c) {
  return (a.v - c.v) * (b.u - c.u) - (a.u - c.u) * (b.v - c.v);
}

}  // namespace sphparam
