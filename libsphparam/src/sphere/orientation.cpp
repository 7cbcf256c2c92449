#include "sphparam/sphere/orientation.h"

#include <array>
#include <cmath>

#include "exact_integers.h"
#include "ieee_arithmetic.h"

// The filter. Let u = 2⁻⁵³ and all entries exact. Each of the six products x·y is off by at most u
// of itself, each difference of two by another u, the product with the third factor by another, and
// the two sums by two more: every one of the six triple products that make up the determinant
// carries at most five factors (1 + δ), |δ| ≤ u. So the error is at most 5u + O(u²) times the
// permanent Σ|aᵢ|(|bⱼcₖ| + |bₖcⱼ|); the permanent itself is computed too small by at most the same
// factor. 8u = 2⁻⁵⁰ covers both. Products may underflow or overflow only outside the window that
// is tested for the permanent: each triple product is either at least 1e-270·2⁻⁶⁰ or so small that
// its absolute error, at most 2⁻¹⁰²² where subnormal numbers are flushed to zero (times an entry
// ≤ 2⁶⁴), drowns in 2⁻⁵²·1e-270.
// Contraction to fused multiply-adds would not hurt the bound, but is off for identical bits.

namespace sphparam {
namespace {

/// A row scaled by a power of two to integers: the sign of the determinant does not change.
std::array<BigInteger, 3> integer_row(const Vector3& row) {
  return as_integers<3>({row[0], row[1], row[2]});
}

}  // namespace

int exact_orientation(const Vector3& a, const Vector3& b, const Vector3& c) {
  const auto p = integer_row(a), q = integer_row(b), r = integer_row(c);
  const BigInteger det = p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                         p[2] * (q[0] * r[1] - q[1] * r[0]);
  return det.sign();
}

int orientation(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double bc = b[1] * c[2], cb = b[2] * c[1];
  const double ca = b[2] * c[0], ac = b[0] * c[2];
  const double ab = b[0] * c[1], ba = b[1] * c[0];
  const double det = a[0] * (bc - cb) + a[1] * (ca - ac) + a[2] * (ab - ba);
  const double permanent = std::abs(a[0]) * (std::abs(bc) + std::abs(cb)) +
                           std::abs(a[1]) * (std::abs(ca) + std::abs(ac)) +
                           std::abs(a[2]) * (std::abs(ab) + std::abs(ba));
  if (permanent > 1e-270 && permanent < 1e300) {
    const double bound = 0x1p-50 * permanent;
    if (det > bound) return 1;
    if (-det > bound) return -1;
  }
  return exact_orientation(a, b, c);
}

}  // namespace sphparam
