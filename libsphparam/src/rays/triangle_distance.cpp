// p − a = s (b − a) + t (c − a) + h n: s and t by the normal n = (b − a) × (c − a), of any length;
// on a side, the parameter of the foot of p, clamped to [0, 1].

#include "rays/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace sphparam {

namespace {

/// Where on the side from the origin to `side` the nearest point to p is. 0 for a side of no
/// length.
double clamped_foot(const Vector3& p, const Vector3& side) {
  const double along = p.dot(side), length = side.squaredNorm();
  if (!(along > 0)) return 0;
  return along < length ? along / length : 1;
}

/// Times a power of two where a product with another normal would be no number, or 0: that is a
/// fourth power of lengths.
Vector3 with_products(const Vector3& normal) {
  constexpr double least = 0x1p-300, most = 0x1p300;
  const double size = normal.cwiseAbs().maxCoeff();
  if ((size > least && size < most) || !(size > 0)) return normal;
  return std::ldexp(1.0, std::clamp(-std::ilogb(size), -1022, 1022)) * normal;
}

}  // namespace

TrianglePoint nearest_on_triangle(const Vector3& p, const Vector3& a, const Vector3& b,
                                  const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a, bc = c - b, ap = p - a;
  const double ab_foot = clamped_foot(ap, ab), ac_foot = clamped_foot(ap, ac),
               bc_foot = clamped_foot(p - b, bc);
  TrianglePoint best = {{1 - ab_foot, ab_foot, 0}, (ap - ab_foot * ab).squaredNorm()};
  const auto consider = [&](const Vector3& weights, double squared) {
    if (squared < best.squared_distance) best = {weights, squared};
  };
  consider({1 - ac_foot, 0, ac_foot}, (ap - ac_foot * ac).squaredNorm());
  consider({0, 1 - bc_foot, bc_foot}, (p - b - bc_foot * bc).squaredNorm());
  const Vector3 cross = ab.cross(ac), normal = with_products(cross);
  const double area = cross.dot(normal);
  const double s = ap.cross(ac).dot(normal), t = ab.cross(ap).dot(normal);
  if (s > 0 && t > 0 && s + t < area) {
    const double u = s / area, v = t / area;
    consider({1 - u - v, u, v}, (ap - u * ab - v * ac).squaredNorm());
  }
  return best;
}

}  // namespace sphparam
