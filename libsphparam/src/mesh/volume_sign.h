#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Exact sign of det(b − a, c − a, d − a): +1 where d lies on that side of the plane of a, b, c
/// from which they run counter-clockwise, 0 in the plane. Requires: finite entries, |entry| ≤ 2⁶⁴.
/// Source: the static filter of Shewchuk, "Adaptive precision floating-point arithmetic" (1997),
/// then integers. Cost: about 10 ns; some µs where the filter leaves it open.
int volume_sign(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Exact sign of the area of a triangle as it is seen along an axis (0 to 2): +1 where it runs
/// counter-clockwise from that axis' far end. Requires and cost: as above.
int area_sign(const Vector3& a, const Vector3& b, const Vector3& c, int axis);

}  // namespace sphparam
