#pragma once

#include <Eigen/LU>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// xᵀAx − 2 bᵀx + c: squared distances from planes, weighted and added up.
struct Quadric {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Vector3 b = Vector3::Zero();
  double c = 0;

  /// Of the triangle's plane, weighted by its area, and a little of its corners' mean.
  static Quadric of_triangle(const Vector3& p, const Vector3& q, const Vector3& r) {
    constexpr double evenness = 1e-3;
    const Vector3 twice = (q - p).cross(r - p), mean = (p + q + r) / 3;
    const double area = twice.norm() / 2;
    if (!(area > 0)) return {};
    const Vector3 n = twice / (2 * area);
    const Eigen::Matrix3d a = area * (n * n.transpose() + evenness * Eigen::Matrix3d::Identity());
    return {a, a * mean, mean.dot(a * mean)};
  }

  Quadric& operator+=(const Quadric& other) {
    a += other.a;
    b += other.b;
    c += other.c;
    return *this;
  }
  Quadric operator+(const Quadric& other) const { return Quadric(*this) += other; }

  double at(const Vector3& x) const { return x.dot(a * x) - 2 * b.dot(x) + c; }

  /// Where it is least; `otherwise` where that cannot be told.
  Vector3 lowest(const Vector3& otherwise) const {
    const Vector3 x = a.inverse() * b;
    return x.allFinite() ? x : otherwise;
  }
};

}  // namespace sphparam
