#pragma once

#include <Eigen/Geometry>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Two unit vectors of the tangent plane at the unit vector x, right-handed with x.
inline Eigen::Matrix<double, 3, 2> tangent_basis(const Vector3& x) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = x.unitOrthogonal();
  basis.col(1) = x.cross(basis.col(0));
  return basis;
}

/// The point that lies at tangent coordinates d, back on the sphere.
inline Vector3 moved_on_sphere(const Vector3& x, const Eigen::Vector2d& d) {
  return (x + tangent_basis(x) * d).normalized();
}

}  // namespace sphparam
