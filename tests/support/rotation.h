#pragma once

#include <Eigen/Geometry>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::tests {

/// The shortest rotation that takes one direction to another, by Rodrigues' formula;
/// Quaterniond::FromTwoVectors would instantiate a singular value decomposition for its one special
/// case.
inline Eigen::Matrix3d rotation_between(const Vector3& from, const Vector3& to) {
  const Vector3 a = from.normalized(), b = to.normalized();
  const double cosine = a.dot(b);
  if (cosine < -1 + 1e-9) {  // a half-turn about any axis across
    const Vector3 axis = a.unitOrthogonal();
    return 2 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
  }
  const Vector3 v = a.cross(b);
  Eigen::Matrix3d turn = v * v.transpose() / (1 + cosine);
  turn += cosine * Eigen::Matrix3d::Identity();
  Eigen::Matrix3d skew;
  skew << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return turn + skew;
}

}  // namespace sphparam::tests
