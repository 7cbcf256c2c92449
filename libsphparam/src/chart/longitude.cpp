#include "chart/longitude.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "elementary.h"
#include "sphere/difference_of_products.h"
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

namespace {

/// Not 0 but at the poles.
double distance_from_axis(const Vector3& ray) {
  const double x = ray.x(), y = ray.y(), square = x * x + y * y;
  return square > 1e-280 ? std::sqrt(square) : elementary::hypot(x, y);
}

/// Of a ray with these angles; at ±z they do not matter.
ChartPoint chart_point(const Vector3& ray, double theta, double phi) {
  if (at_pole(ray)) return {0, ray.z() > 0 ? 0.0 : 1.0};
  const double v = std::clamp(phi * std::numbers::inv_pi, above_zero, below_one);
  if (on_meridian(ray)) return {0, v};
  const double y = ray.y(), turns = y == 0 ? 0.5 : theta * (0.5 * std::numbers::inv_pi);
  return {y < 0 ? std::clamp(1 + turns, 0.5, below_one) : std::clamp(turns, above_zero, 0.5), v};
}

}  // namespace

ChartPoint chart_point(const Vector3& ray) {
  return chart_point(ray, elementary::atan2(ray.y(), ray.x()),
                     elementary::atan2(distance_from_axis(ray), ray.z()));
}

void chart_points(std::span<const Vector3> rays, std::span<ChartPoint> points) {
  constexpr size_t most = 64;
  std::array<double, 2 * most> y, x, angles;  // of each, θ and ϕ
  while (!rays.empty()) {
    const size_t count = std::min(most, rays.size());
    for (size_t i = 0; i < count; ++i) {
      y[2 * i] = rays[i].y(), x[2 * i] = rays[i].x();
      y[2 * i + 1] = distance_from_axis(rays[i]), x[2 * i + 1] = rays[i].z();
    }
    elementary::atan2(std::span(y).first(2 * count), std::span(x).first(2 * count),
                      std::span(angles).first(2 * count));
    for (size_t i = 0; i < count; ++i)
      points[i] = chart_point(rays[i], angles[2 * i], angles[2 * i + 1]);
    rays = rays.subspan(count);
    points = points.subspan(count);
  }
}

}  // namespace sphparam
