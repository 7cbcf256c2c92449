// Directions are projected from the centre onto the side of the cube they meet, where right and up
// are those of someone who looks at it from outside. Letters are strokes with round ends: the
// distance to the nearest one tells ink from ground, and how far away the border is.

#include "texture/axis_letters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "elementary.h"

namespace sphparam {
namespace {

struct Point2 {
  double x, y;
};
struct Stroke {
  Point2 a, b;
};

// On the side of the cube, which is [−1, 1]²: the sign to the left, the letter to the right.
constexpr double thickness = 0.062;  // half of a stroke's
constexpr double rim_width = 0.035;  // of the light frame
constexpr std::array<Stroke, 2> plus = {
    {{{-0.52, 0}, {-0.16, 0}}, {{-0.34, -0.18}, {-0.34, 0.18}}}};
constexpr std::array<Stroke, 1> minus = {{{{-0.52, 0}, {-0.16, 0}}}};
constexpr std::array<Stroke, 2> letter_x = {
    {{{0.08, -0.32}, {0.5, 0.32}}, {{0.08, 0.32}, {0.5, -0.32}}}};
constexpr std::array<Stroke, 3> letter_y = {
    {{{0.08, 0.32}, {0.29, 0.02}}, {{0.5, 0.32}, {0.29, 0.02}}, {{0.29, 0.02}, {0.29, -0.32}}}};
constexpr std::array<Stroke, 3> letter_z = {
    {{{0.08, 0.32}, {0.5, 0.32}}, {{0.5, 0.32}, {0.08, -0.32}}, {{0.08, -0.32}, {0.5, -0.32}}}};

double distance(const Point2& p, const Stroke& stroke) {
  const double dx = stroke.b.x - stroke.a.x, dy = stroke.b.y - stroke.a.y;
  const double t = ((p.x - stroke.a.x) * dx + (p.y - stroke.a.y) * dy) / (dx * dx + dy * dy);
  const double along = std::clamp(t, 0.0, 1.0);
  return elementary::hypot(p.x - stroke.a.x - along * dx, p.y - stroke.a.y - along * dy);
}

double distance(const Point2& p, std::span<const Stroke> strokes) {
  double least = std::numeric_limits<double>::infinity();
  for (const Stroke& stroke : strokes) least = std::min(least, distance(p, stroke));
  return least;
}

std::span<const Stroke> letter(int axis) {
  if (axis == 0) return letter_x;
  if (axis == 1) return letter_y;
  return letter_z;
}

/// Where a direction meets the side of the cube: right and up as seen from outside.
Point2 on_side(const Vector3& direction, int axis, double sign) {
  const Vector3 outward = sign * Vector3::Unit(axis);
  const Vector3 up = axis == 2 ? Vector3(Vector3::UnitY()) : Vector3(Vector3::UnitZ());
  const double depth = std::abs(direction[axis]);
  return {direction.dot(up.cross(outward)) / depth, direction.dot(up) / depth};
}

}  // namespace

AxisPoint axis_picture(const Vector3& direction) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const bool positive = direction[axis] > 0;
  const Point2 p = on_side(direction, axis, positive ? 1 : -1);
  const std::span<const Stroke> sign =
      positive ? std::span<const Stroke>(plus) : std::span<const Stroke>(minus);
  const double ink = std::min(distance(p, sign), distance(p, letter(axis))) - thickness;
  const double rim = 1 - rim_width - std::max(std::abs(p.x), std::abs(p.y));

  static const std::array<Eigen::Vector3f, 3> grounds = {
      {{0.86F, 0.30F, 0.26F}, {0.33F, 0.66F, 0.30F}, {0.25F, 0.45F, 0.85F}}};
  const Eigen::Vector3f light(0.96F, 0.96F, 0.94F);
  const Eigen::Vector3f ground = (positive ? 1.0F : 0.55F) * grounds[static_cast<size_t>(axis)];
  // A step of α on the sphere is at most α(1 + x² + y²) on the side.
  const double margin = std::min(std::abs(ink), std::abs(rim)) / (1 + p.x * p.x + p.y * p.y);
  return {ink < 0 || rim < 0 ? light : ground, margin};
}

}  // namespace sphparam
