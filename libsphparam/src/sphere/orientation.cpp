#include "sphparam/sphere/orientation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "sphere/ieee_arithmetic.h"

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

using BigInteger = boost::multiprecision::cpp_int;

struct Scaled {
  std::int64_t mantissa;
  int exponent;
};

/// x = mantissa·2^exponent, from its bits: arithmetic may take a subnormal x for zero.
Scaled scaled(double x) {
  constexpr std::uint64_t one = std::uint64_t{1} << 52;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto biased = static_cast<int>(bits >> 52 & 0x7ff);
  const auto size = static_cast<std::int64_t>((bits & (one - 1)) | (biased > 0 ? one : 0));
  return {bits >> 63 ? -size : size, std::max(biased, 1) - 1075};
}

/// A row scaled by a power of two to integers: the sign of the determinant does not change.
std::array<BigInteger, 3> integer_row(const Vector3& row) {
  const std::array<Scaled, 3> entries{scaled(row[0]), scaled(row[1]), scaled(row[2])};
  int lowest = std::numeric_limits<int>::max();
  for (const Scaled& entry : entries) {
    if (entry.mantissa != 0) lowest = std::min(lowest, entry.exponent);
  }
  std::array<BigInteger, 3> result;
  for (size_t i = 0; i < 3; ++i) {
    result[i] = entries[i].mantissa;
    if (entries[i].mantissa != 0) result[i] <<= entries[i].exponent - lowest;
  }
  return result;
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
