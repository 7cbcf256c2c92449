#pragma once

#include <array>
#include <span>

#include "sphparam/chart/spherical_chart.h"

namespace sphparam {

/// A point of the chart. (v, u) in this order: faces are counter-clockwise.
struct UvPoint {
  double v, u;
  auto operator<=>(const UvPoint&) const = default;
};

/// What a face of a chart owns of the rectangle: its triangle or, where a corner is at ±z, the
/// trapezoid between its link edge and v = 0 or 1.
class ChartPiece {
 public:
  ChartPiece(const SphericalChart& chart, Face face);

  Face face() const { return face_; }
  bool is_trapezoid() const { return size_ == 4; }
  std::span<const UvPoint> outline() const { return {corners_.data(), size_}; }
  std::span<const UvPoint> triangle() const { return triangle_; }
  double low() const { return low_; }  // range of v
  double high() const { return high_; }
  double area() const;  // of the outline, in (u, v)

  /// Exact. A point on an edge belongs to the piece that it lies in after a move to the east and,
  /// much less, to the north.
  bool holds(const UvPoint& p) const;

  /// Weights of the triangle's corners 0 and 1 at p, within [0, 1]; of a trapezoid, those of the
  /// nearest point of the triangle at the same v.
  std::array<double, 2> weights(UvPoint p) const;

  /// What the weights change by in a turn of v (0) or u (1).
  std::array<double, 2> gradient(int axis) const;

 private:
  Face face_;
  size_t size_;  // 3, or 4 at a pole
  std::array<UvPoint, 4> corners_;
  std::array<UvPoint, 3> triangle_;
  double low_, high_;
};

/// The range of u of a convex polygon at a height v, up to rounding; (2, −1) where it has none.
std::array<double, 2> range_at(std::span<const UvPoint> polygon, double v);

}  // namespace sphparam
