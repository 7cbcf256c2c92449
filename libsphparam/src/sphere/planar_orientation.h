#pragma once

namespace sphparam {

/// A point of the (u, v) rectangle.
struct ChartPoint {
  double u, v;
};

/// Exact sign of the area of a triangle in the (u, v) plane: +1 when it runs as a face that is
/// counter-clockwise on the sphere. v points south, so that is counter-clockwise in (v, u).
/// Requires: finite entries, |entry| ≤ 2⁶⁴. Cost: about 3 ns; some µs on the exact path.
int planar_orientation(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c);

/// Twice that area, in floating point.
inline double planar_area(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c) {
  return (a.v - c.v) * (b.u - c.u) - (a.u - c.u) * (b.v - c.v);
}

}  // namespace sphparam
