#include "sphparam/sphere/spherical_coordinates.h"

#include <numbers>

#include "elementary.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

Vector3 to_cartesian(SphericalCoordinates c) {
  const double s = elementary::sin(c.phi);
  return {elementary::cos(c.theta) * s, elementary::sin(c.theta) * s, elementary::cos(c.phi)};
}

SphericalCoordinates to_spherical(const Vector3& ray) {
  constexpr double two_pi = 2 * std::numbers::pi;
  double theta = elementary::atan2(ray.y(), ray.x());
  if (ray.x() == 0 && ray.y() == 0) theta = 0;  // atan2(0, −0) is π
  if (theta < 0) theta += two_pi;
  if (theta >= two_pi) theta = 0;  // −1e-17 + 2π rounds to 2π
  return {theta, elementary::atan2(elementary::hypot(ray.x(), ray.y()), ray.z())};
}

SphereMap normalised(Points rays) {
  // stableNorm: the fallbacks make rays too long or too short to square.
  for (Eigen::Index v = 0; v < rays.rows(); ++v) rays.row(v) /= rays.row(v).stableNorm();
  return {std::move(rays)};
}

}  // namespace sphparam
