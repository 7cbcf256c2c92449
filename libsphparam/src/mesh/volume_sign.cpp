#include "mesh/volume_sign.h"

#include <cmath>

#include "exact_integers.h"
#include "ieee_arithmetic.h"

// Shewchuk's first filters (1997, Sections 4.3 and 4.4): with δ = 2⁻⁵³ the determinant of rounded
// differences is off by less than (7 + 56δ)δ of its permanent as computed, the area by less than
// (3 + 16δ)δ; 8δ and 4δ cover these. Entries are at most 2⁶⁴: what differences and products lose
// where they underflow, 2⁻¹⁰²² each even if subnormal numbers are flushed to zero, is 2⁻⁸⁸⁹ at most
// in the end, which drowns in the bound where the permanent is 1e-240 or more.

namespace sphparam {
namespace {

constexpr double least_permanent = 1e-240;

/// What a filter says of a determinant: its sign, or 0 for nothing.
int filtered(double determinant, double permanent, double share) {
  if (!(permanent > least_permanent)) return 0;
  const double bound = share * permanent;
  return determinant > bound ? 1 : -determinant > bound ? -1 : 0;
}

/// In a plane across an axis, as many flat walls are.
bool are_level(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const auto level = [&](int k) { return a[k] == b[k] && a[k] == c[k] && a[k] == d[k]; };
  return level(0) || level(1) || level(2);
}

int exact_volume_sign(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const auto x =
      as_integers<12>({a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]});
  const auto from_a = [&](std::size_t point, std::size_t k) {
    return BigInteger(x[3 * point + k] - x[k]);
  };
  const BigInteger p0 = from_a(1, 0), p1 = from_a(1, 1), p2 = from_a(1, 2);
  const BigInteger q0 = from_a(2, 0), q1 = from_a(2, 1), q2 = from_a(2, 2);
  const BigInteger r0 = from_a(3, 0), r1 = from_a(3, 1), r2 = from_a(3, 2);
  const BigInteger determinant =
      p0 * (q1 * r2 - q2 * r1) + p1 * (q2 * r0 - q0 * r2) + p2 * (q0 * r1 - q1 * r0);
  return determinant.sign();
}

}  // namespace

int volume_sign(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 p = b - a, q = c - a, r = d - a;
  const double qr = q[1] * r[2], rq = q[2] * r[1];
  const double rp = q[2] * r[0], pr = q[0] * r[2];
  const double pq = q[0] * r[1], qp = q[1] * r[0];
  const double determinant = p[0] * (qr - rq) + p[1] * (rp - pr) + p[2] * (pq - qp);
  const double permanent = std::abs(p[0]) * (std::abs(qr) + std::abs(rq)) +
                           std::abs(p[1]) * (std::abs(rp) + std::abs(pr)) +
                           std::abs(p[2]) * (std::abs(pq) + std::abs(qp));
  if (const int sign = filtered(determinant, permanent, 0x1p-50)) return sign;
  return are_level(a, b, c, d) ? 0 : exact_volume_sign(a, b, c, d);
}

int area_sign(const Vector3& a, const Vector3& b, const Vector3& c, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double left = (a[u] - c[u]) * (b[v] - c[v]), right = (a[v] - c[v]) * (b[u] - c[u]);
  if (const int sign = filtered(left - right, std::abs(left) + std::abs(right), 0x1p-51))
    return sign;
  const auto at_one_place = [&](const Vector3& p, const Vector3& q) {
    return p[u] == q[u] && p[v] == q[v];
  };
  if (at_one_place(a, b) || at_one_place(b, c) || at_one_place(c, a)) return 0;
  const auto x = as_integers<6>({a[u], a[v], b[u], b[v], c[u], c[v]});
  const BigInteger area = (x[0] - x[4]) * (x[3] - x[5]) - (x[1] - x[5]) * (x[2] - x[4]);
  return area.sign();
}

}  // namespace sphparam
