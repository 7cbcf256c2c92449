#include "mesh/volume_sign.h"

#include <array>
#include <cstddef>

#include "exact_integers.h"
#include "sign_filter.h"

// Shewchuk's first filters (1997, Sections 4.3 and 4.4): with δ = 2⁻⁵³ the determinant of rounded
// differences is off by less than (7 + 56δ)δ of its permanent as computed, the area by less than
// (3 + 16δ)δ; 8δ and 4δ cover these. Entries are at most 2⁶⁴: what differences and products lose
// where they underflow, 2⁻¹⁰²² each even if subnormal numbers are flushed to zero, is 2⁻⁸⁸⁹ at most
// in the end, which drowns in the bound where the permanent is 1e-240 or more.

namespace sphparam {
namespace {

constexpr double least_permanent = 1e-240;

/// 0: the filter leaves it open.
int certain_sign(const FilteredSum& sum, double share) {
  return sum.size > least_permanent ? sum.sign(share) : 0;
}

/// In a plane across an axis, as many flat walls are.
bool are_level(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const auto level = [&](int k) { return a[k] == b[k] && a[k] == c[k] && a[k] == d[k]; };
  return level(0) || level(1) || level(2);
}

int exact_volume_sign(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const auto x =
      as_integers<12>({a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]});
  const auto from_a = [&](std::size_t point) {
    const std::size_t first = 3 * point;
    return std::array<BigInteger, 3>{x[first] - x[0], x[first + 1] - x[1], x[first + 2] - x[2]};
  };
  return determinant(from_a(1), from_a(2), from_a(3)).sign();
}

}  // namespace

int volume_sign(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const FilteredSum volume = filtered_determinant(b - a, c - a, d - a);
  if (const int sign = certain_sign(volume, 0x1p-50)) return sign;
  return are_level(a, b, c, d) ? 0 : exact_volume_sign(a, b, c, d);
}

int area_sign(const Vector3& a, const Vector3& b, const Vector3& c, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const FilteredSum area =
      filtered_difference((a[u] - c[u]) * (b[v] - c[v]), (a[v] - c[v]) * (b[u] - c[u]));
  if (const int sign = certain_sign(area, 0x1p-51)) return sign;
  const auto at_one_place = [&](const Vector3& p, const Vector3& q) {
    return p[u] == q[u] && p[v] == q[v];
  };
  if (at_one_place(a, b) || at_one_place(b, c) || at_one_place(c, a)) return 0;
  const auto x = as_integers<6>({a[u], a[v], b[u], b[v], c[u], c[v]});
  const BigInteger exact = (x[0] - x[4]) * (x[3] - x[5]) - (x[1] - x[5]) * (x[2] - x[4]);
  return exact.sign();
}

}  // namespace sphparam
