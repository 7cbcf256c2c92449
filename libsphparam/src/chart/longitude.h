#pragma once

#include <span>

#include "sphere/planar_orientation.h"
#include "sphparam/mesh/triangle_mesh.h"

/// On which side of the meridian θ = 0 a ray lies: signs of its doubles, exact.
namespace sphparam {

inline bool at_pole(const Vector3& x) { return x.x() == 0 && x.y() == 0; }
inline bool on_meridian(const Vector3& x) { return x.y() == 0 && x.x() > 0; }
inline bool in_west(const Vector3& x) { return x.y() < 0; }

/// Does the geodesic edge cross the open half-circle θ = 0 between its ends? Exact.
bool crosses_meridian(const Vector3& a, const Vector3& b);

/// Where an edge meets a meridian: at (1 − t)·a + t·b, a ray of unit length.
struct Crossing {
  double t;
  Vector3 point;
};

/// Where the edge from a to b crosses the half-circle from pole to pole through a ray. The x and y
/// of the point are that ray's but for their length: on y = 0, that is exact.
/// Requires: a and b on different sides of it.
Crossing meridian_crossing(const Vector3& a, const Vector3& b, const Vector3& through);

/// u = θ/2π, v = ϕ/π of a ray. Ensures: strictly inside the rectangle, but u = 0 on the meridian;
/// v = 0 or 1 at ±z.
ChartPoint chart_point(const Vector3& ray);
/// Of many, to the same bits. Requires: as many points as rays. Cost: half of one by one.
void chart_points(std::span<const Vector3> rays, std::span<ChartPoint> points);

}  // namespace sphparam
