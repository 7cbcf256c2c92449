#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Exact sign of det(a, b, c): +1 when a, b, c run counter-clockwise about the origin seen from
/// outside, 0 when the three rays lie in a plane.
///
/// A floating-point filter decides almost all calls (error bound 2⁻⁵⁰ times the permanent, proof
/// in the source file), integer arithmetic the rest. Requires: finite entries, |entry| ≤ 2⁶⁴.
/// Our own, after the static filters of Shewchuk, "Adaptive precision floating-point arithmetic"
/// (1997). Cost: about 10 ns; some µs on the exact path.
int orientation(const Vector3& a, const Vector3& b, const Vector3& c);

/// The exact path alone, for tests.
int exact_orientation(const Vector3& a, const Vector3& b, const Vector3& c);

}  // namespace sphparam
