#pragma once

#include <algorithm>
#include <cmath>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A triangle on the screen. Barycentric coordinate k at (x, y) is value[k] + x·dx[k] + y·dy[k].
struct ScreenTriangle {
  Eigen::Vector3d value, dx, dy;
  bool empty;  // edge-on, or not on the screen

  Eigen::Vector3d barycentric(double x, double y) const { return value + x * dx + y * dy; }

  /// Corners in screen coordinates (x, y; z is not looked at).
  ScreenTriangle(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
    empty = !(std::abs(area) > 0) || !std::isfinite(area);
    if (empty) return;
    dx = Eigen::Vector3d(b.y() - c.y(), c.y() - a.y(), a.y() - b.y()) / area;
    dy = Eigen::Vector3d(c.x() - b.x(), a.x() - c.x(), b.x() - a.x()) / area;
    value = Eigen::Vector3d(1, 0, 0) - a.x() * dx - a.y() * dy;
  }
};

/// Calls visit(x, y, barycentric) for every sample (x + ½, y + ½) of the box [x0, x1) × [y0, y1)
/// that the triangle covers.
template <class Visit>
void for_each_sample(const Vector3& a, const Vector3& b, const Vector3& c, int x0, int y0, int x1,
                     int y1, Visit&& visit) {
  const auto first = [](double low, int bound) {
    return std::max<double>(bound, std::ceil(low - 0.5));
  };
  const auto last = [](double high, int bound) {
    return std::min<double>(bound - 1, std::floor(high - 0.5));
  };
  const double left = first(std::min({a.x(), b.x(), c.x()}), x0);
  const double right = last(std::max({a.x(), b.x(), c.x()}), x1);
  const double top = first(std::min({a.y(), b.y(), c.y()}), y0);
  const double bottom = last(std::max({a.y(), b.y(), c.y()}), y1);
  if (!(left <= right) || !(top <= bottom)) return;
  const ScreenTriangle triangle(a, b, c);
  if (triangle.empty) return;
  for (int y = static_cast<int>(top); y <= static_cast<int>(bottom); ++y) {
    for (int x = static_cast<int>(left); x <= static_cast<int>(right); ++x) {
      const Eigen::Vector3d weights = triangle.barycentric(x + 0.5, y + 0.5);
      if (weights.minCoeff() >= 0) visit(x, y, weights);
    }
  }
}

}  // namespace sphparam
