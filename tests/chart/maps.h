#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "sphparam/sphere/sphere_map.h"
#include "support/rotation.h"

/// Maps to make charts of.
namespace sphparam::tests {

inline SphereMap rotated(const SphereMap& map, const Eigen::Matrix3d& rotation) {
  return {map.points * rotation.transpose()};
}

inline Eigen::Matrix3d random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

/// The map turned so that a direction comes to lie at +z, but for rounding.
inline SphereMap aimed(const SphereMap& map, const Vector3& direction) {
  return rotated(map, rotation_between(direction, Vector3::UnitZ()));
}

/// Everything within 0.7 radians of +z contracted about it.
inline SphereMap squashed(SphereMap map, double factor) {
  for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
    const Vector3 x = map.points.row(v);
    const double phi = std::atan2(std::hypot(x.x(), x.y()), x.z()),
                 theta = std::atan2(x.y(), x.x());
    if (phi >= 0.7) continue;
    const double s = std::sin(factor * phi);
    map.points.row(v) << std::cos(theta) * s, std::sin(theta) * s, std::cos(factor * phi);
  }
  return map;
}

}  // namespace sphparam::tests
