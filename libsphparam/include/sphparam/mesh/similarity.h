#pragma once

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Alike for any width of vectors.
using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;

/// x ↦ scale · rotation · x + shift.
struct Similarity {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3 shift = Vector3::Zero();

  Vector3 operator()(const Vector3& x) const { return scale * (rotation * x) + shift; }
  /// What takes (x, y, z, 1), a column, there.
  Matrix4 matrix() const {
    Matrix4 result = Matrix4::Identity();
    result.topLeftCorner<3, 3>() = scale * rotation;
    result.topRightCorner<3, 1>() = shift;
    return result;
  }
};

/// Every row of them. Cost: one pass.
inline Points moved(Points points, const Similarity& similarity) {
  for (Eigen::Index v = 0; v < points.rows(); ++v) points.row(v) = similarity(points.row(v));
  return points;
}

}  // namespace sphparam
