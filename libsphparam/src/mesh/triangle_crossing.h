#pragma once

#include <array>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

using TriangleCorners = std::array<Vector3, 3>;

/// Whether two triangles cross: their insides have a point in common, exactly. So do triangles that
/// pass through one another, lie over one another in a plane, or do either beside a corner or a
/// side that they share; not those that only touch, whose sides and corners are no inside. One
/// without area has none. Requires: finite entries, |entry| ≤ 2⁶⁴. Source: Guigue and Devillers,
/// "Fast and robust triangle-triangle overlap test using orientation predicates" (2003), with the
/// signs that take sides out. Cost: about 50 ns where it does not come to integers.
bool triangles_cross(const TriangleCorners& s, const TriangleCorners& t);

}  // namespace sphparam
