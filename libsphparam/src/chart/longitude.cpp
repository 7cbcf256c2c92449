#include "chart/longitude.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sphparam/sphere/orientation.h"

// The edge between a (y < 0) and b (y > 0) meets the plane y = 0 in the ray b_y a − a_y b, whose x
// is det(a, b, e_z): its sign says whether that is at θ = 0 or at θ = π.

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

Crossing meridian_crossing(const Vector3& a, const Vector3& b) {
  const Vector3 &west = a.y() < 0 ? a : b, &east = a.y() < 0 ? b : a;
  // x is positive exactly: where rounding loses that, it is as small as can be.
  const double x = difference_of_products(west.x(), east.y(), east.x(), west.y());
  const double z = difference_of_products(west.z(), east.y(), east.z(), west.y());
  return {a.y() / (a.y() - b.y()), Vector3(std::max(x, above_zero), 0, z).stableNormalized()};
}

ChartPoint chart_point(const Vector3& ray) {
  const double x = ray.x(), y = ray.y(), z = ray.z();
  if (at_pole(ray)) return {0, z > 0 ? 0.0 : 1.0};
  const double square = x * x + y * y;
  const double radius = square > 1e-280 ? std::sqrt(square) : std::hypot(x, y);
  const double v = std::clamp(std::atan2(radius, z) * std::numbers::inv_pi, above_zero, below_one);
  if (on_meridian(ray)) return {0, v};
  const double turns = y == 0 ? 0.5 : std::atan2(y, x) * (0.5 * std::numbers::inv_pi);
  return {y < 0 ? std::clamp(1 + turns, 0.5, below_one) : std::clamp(turns, above_zero, 0.5), v};
}

}  // namespace sphparam
