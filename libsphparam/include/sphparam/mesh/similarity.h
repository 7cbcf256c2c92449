#pragma once

#include <array>
#include <cstddef>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// x ↦ scale · rotation · x + shift.
struct Similarity {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3 shift = Vector3::Zero();

  Vector3 operator()(const Vector3& x) const { return scale * (rotation * x) + shift; }
  /// The rows of what takes (x, y, z, 1), a column, there.
  std::array<std::array<double, 4>, 4> matrix() const {
    std::array<std::array<double, 4>, 4> rows = {};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        rows[static_cast<size_t>(i)][static_cast<size_t>(j)] = scale * rotation(i, j);
      rows[static_cast<size_t>(i)][3] = shift[i];
    }
    rows[3][3] = 1;
    return rows;
  }
};

/// Every row of them. Cost: one pass.
inline Points moved(Points points, const Similarity& similarity) {
  for (Eigen::Index v = 0; v < points.rows(); ++v) points.row(v) = similarity(points.row(v));
  return points;
}

}  // namespace sphparam
