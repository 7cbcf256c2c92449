#include "embedding/frame/nearest_rotation.h"

#include <Eigen/SVD>
#include <cmath>

#include "mesh/triangle_geometry.h"

// Σ w to·fromᵀ = U S Vᵀ;  R = U diag(1, 1, ±1) Vᵀ with the sign that makes det R = 1. Sums go row
// by row, in one order.

namespace sphparam {

Eigen::Matrix3d nearest_rotation(const Points& from, const Points& to, const VectorX& weights) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (Eigen::Index v = 0; v < from.rows(); ++v) {
    covariance += weights[v] * Vector3(to.row(v)) * from.row(v);
  }
  return rotation_of(covariance);
}

Eigen::Matrix3d rotation_of(const Eigen::Matrix3d& covariance) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
  return u * svd.matrixV().transpose();
}

SphereMap turned(const SphereMap& map, const Eigen::Matrix3d& rotation) {
  SphereMap result{Points(map.points.rows(), 3)};
  for (Vertex v = 0; v < map.points.rows(); ++v) {
    result.points.row(v) = (rotation * map.point(v)).normalized();
  }
  return result;
}

double rms_angle(const SphereMap& a, const SphereMap& b, const VectorX& weights) {
  double squares = 0, sum = 0;
  for (Vertex v = 0; v < a.points.rows(); ++v) {
    const double angle = angle_between(a.point(v), b.point(v));
    squares += weights[v] * angle * angle;
    sum += weights[v];
  }
  return std::sqrt(squares / sum);
}

}  // namespace sphparam
