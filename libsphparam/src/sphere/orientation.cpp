#include "sphparam/sphere/orientation.h"

#include <array>

#include "exact_integers.h"
#include "sign_filter.h"

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
  return determinant(integer_row(a), integer_row(b), integer_row(c)).sign();
}

int orientation(const Vector3& a, const Vector3& b, const Vector3& c) {
  const FilteredSum det = filtered_determinant(a, b, c);
  if (det.size > 1e-270 && det.size < 1e300) {
    if (const int sign = det.sign(0x1p-50)) return sign;
  }
  return exact_orientation(a, b, c);
}

}  // namespace sphparam
