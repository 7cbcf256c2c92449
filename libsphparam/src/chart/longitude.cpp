#include "chart/longitude.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "elementary.h"
#include "sphparam/sphere/orientation.h"

// The edge from a to b meets the meridian plane of a ray c in ±(det(c, b)·a − det(c, a)·b), where
// det is of x and y alone. Its x and y are ±det(a, b) times those of c. For c = (1, 0) and a in the
// west, det(a, b) = det(a, b, e_z) is positive if the edge crosses at θ = 0, negative at θ = π.

namespace sphparam {
namespace {

constexpr double below_one = 1 - 0x1p-53;
constexpr double above_zero = std::numeric_limits<double>::min();

}  // namespace

bool crosses_meridian(const Vector3& a, const Vector3& b) {
  if (a.y() < 0 && b.y() > 0) return orientation(a, b, Vector3::UnitZ()) > 0;
  if (a.y() > 0 && b.y() < 0) return orientation(b, a, Vector3::UnitZ()) > 0;
  return false;
}

double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  const double error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

Crossing meridian_crossing(const Vector3& a, const Vector3& b, const Vector3& through) {
  const auto det = [](const Vector3& p, const Vector3& q) {
    return difference_of_products(p.x(), q.y(), p.y(), q.x());
  };
  const double at_a = det(through, a), at_b = det(through, b), sign = std::copysign(1.0, at_b);
  // The sign is known: where rounding loses it, the length is as small as can be.
  const double length = std::max(sign * det(a, b), above_zero);
  const double z = sign * difference_of_products(at_b, a.z(), at_a, b.z());
  const Vector3 ray(length * through.x(), length * through.y(), z);
  return {at_a / (at_a - at_b), ray.stableNormalized()};
}

ChartPoint chart_point(const Vector3& ray) {
  const double x = ray.x(), y = ray.y(), z = ray.z();
  if (at_pole(ray)) return {0, z > 0 ? 0.0 : 1.0};
  const double square = x * x + y * y;
  const double radius = square > 1e-280 ? std::sqrt(square) : elementary::hypot(x, y);
  const double v =
      std::clamp(elementary::atan2(radius, z) * std::numbers::inv_pi, above_zero, below_one);
  if (on_meridian(ray)) return {0, v};
  const double turns = y == 0 ? 0.5 : elementary::atan2(y, x) * (0.5 * std::numbers::inv_pi);
  return {y < 0 ? std::clamp(1 + turns, 0.5, below_one) : std::clamp(turns, above_zero, 0.5), v};
}

}  // namespace sphparam
