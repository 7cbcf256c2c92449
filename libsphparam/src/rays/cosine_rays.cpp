// Points evenly spread over the unit disk, lifted onto the hemisphere above it (Malley's method):
// pair i of m lies at radius √((i + shift)/m), at i golden angles of the half-turn.

#include "rays/cosine_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary.h"
#include "rays/random_numbers.h"

namespace sphparam {

namespace {

/// Two unit vectors that make a right-handed frame with a unit normal.
/// Duff et al., "Building an Orthonormal Basis, Revisited" (2017).
std::pair<Eigen::Vector3f, Eigen::Vector3f> tangents(const Eigen::Vector3f& n) {
  const float sign = std::copysign(1.0f, n.z());
  const float a = -1 / (sign + n.z());
  const float b = n.x() * n.y() * a;
  return {{1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()},
          {b, sign + n.y() * n.y() * a, -n.y()}};
}

}  // namespace

CosineRays::CosineRays(int count) : spiral_(static_cast<size_t>((count + 1) / 2)) {
  for (size_t i = 0; i < spiral_.size(); ++i) {
    const double turn = static_cast<double>(i) / std::numbers::phi;
    const double angle = std::numbers::pi * (turn - std::floor(turn));
    spiral_[i] = {static_cast<float>(elementary::cos(angle)),
                  static_cast<float>(elementary::sin(angle))};
  }
}

void CosineRays::aim(const Eigen::Vector3f& axis, std::uint64_t seed,
                     std::span<Eigen::Vector3f> directions) const {
  const auto shift = static_cast<float>(random_fraction(seed, 0));
  const double turn = 2 * std::numbers::pi * random_fraction(seed, 1);
  const auto c = static_cast<float>(elementary::cos(turn)),
             s = static_cast<float>(elementary::sin(turn));
  const auto [first, second] = tangents(axis);
  const Eigen::Vector3f x = c * first + s * second, y = c * second - s * first;
  const float share = 1 / static_cast<float>(spiral_.size());
  for (size_t i = 0; i < spiral_.size(); ++i) {
    const float squared = std::min((static_cast<float>(i) + shift) * share, 1.0f);
    const Eigen::Vector3f across = std::sqrt(squared) * (spiral_[i].x() * x + spiral_[i].y() * y);
    const Eigen::Vector3f along = std::sqrt(1 - squared) * axis;
    directions[2 * i] = along + across;
    directions[2 * i + 1] = along - across;
  }
}

}  // namespace sphparam
