#include "bake/chart_piece.h"

#include <algorithm>

#include "sphere/planar_orientation.h"

// A sign of 0 is decided as if the point were moved by (−ε², ε) in (v, u): the sign of
// det(b − a, δ) then is + iff (v, u) of b is lexicographically greater than that of a, and the same
// edge seen from its other face says −.

namespace sphparam {
namespace {

/// Is p to the left of the edge from a to b, ties decided by the moved point?
bool is_left(const UvPoint& a, const UvPoint& b, const UvPoint& p) {
  const int sign = planar_orientation({a.u, a.v}, {b.u, b.v}, {p.u, p.v});
  return sign != 0 ? sign > 0 : a < b;
}

}  // namespace

std::array<double, 2> range_at(std::span<const UvPoint> polygon, double v) {
  double least = 2, greatest = -1;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const UvPoint &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if (v < std::min(a.v, b.v) || v > std::max(a.v, b.v)) continue;
    const double t = a.v == b.v ? 0 : (v - a.v) / (b.v - a.v), u = a.u + t * (b.u - a.u);
    least = std::min({least, u, a.v == b.v ? b.u : u});
    greatest = std::max({greatest, u, a.v == b.v ? b.u : u});
  }
  return {least, greatest};
}

ChartPiece::ChartPiece(const SphericalChart& chart, Face f) : face_(f), size_(3) {
  for (int k = 0; k < 3; ++k) {
    const auto uv = chart.uv.row(chart.wedges(f, k));
    triangle_[static_cast<size_t>(k)] = {uv[1], uv[0]};
  }
  std::copy(triangle_.begin(), triangle_.end(), corners_.begin());
  if (const int pole = chart.pole_corner(f); pole >= 0) {
    const auto apex = static_cast<size_t>(pole);
    const UvPoint a = triangle_[(apex + 1) % 3], b = triangle_[(apex + 2) % 3];
    const double rim = triangle_[apex].v;
    corners_ = {a, b, UvPoint{rim, b.u}, UvPoint{rim, a.u}};
    size_ = 4;
  }
  low_ = high_ = corners_[0].v;
  for (const UvPoint& corner : outline()) {
    low_ = std::min(low_, corner.v);
    high_ = std::max(high_, corner.v);
  }
}

bool ChartPiece::holds(const UvPoint& p) const {
  for (size_t k = 0; k < size_; ++k) {
    if (!is_left(corners_[k], corners_[(k + 1) % size_], p)) return false;
  }
  return true;
}

/// λ₀ = det(p − p₂, p₁ − p₂) / det(p₀ − p₂, p₁ − p₂), λ₁ likewise, of the nearest point of the
/// triangle at the same v.
std::array<double, 2> ChartPiece::weights(UvPoint p) const {
  if (size_ == 4) {
    const auto [least, greatest] = range_at(triangle_, p.v);
    p.u = std::clamp(p.u, least, greatest);
  }
  const auto& [p0, p1, p2] = triangle_;
  const double det = (p0.v - p2.v) * (p1.u - p2.u) - (p0.u - p2.u) * (p1.v - p2.v);
  const double a = ((p.v - p2.v) * (p1.u - p2.u) - (p.u - p2.u) * (p1.v - p2.v)) / det;
  const double b = ((p0.v - p2.v) * (p.u - p2.u) - (p0.u - p2.u) * (p.v - p2.v)) / det;
  const double first = std::clamp(a, 0.0, 1.0);
  return {first, std::clamp(b, 0.0, 1 - first)};
}

std::array<double, 2> ChartPiece::gradient(int axis) const {
  const auto& [p0, p1, p2] = triangle_;
  const double det = (p0.v - p2.v) * (p1.u - p2.u) - (p0.u - p2.u) * (p1.v - p2.v);
  if (axis == 0) return {(p1.u - p2.u) / det, (p2.u - p0.u) / det};
  return {(p2.v - p1.v) / det, (p0.v - p2.v) / det};
}

double ChartPiece::area() const {
  double twice = 0;
  for (size_t k = 1; k + 1 < size_; ++k) {
    const UvPoint &a = corners_[0], &b = corners_[k], &c = corners_[k + 1];
    twice += (b.v - a.v) * (c.u - a.u) - (b.u - a.u) * (c.v - a.v);
  }
  return twice / 2;
}

}  // namespace sphparam
