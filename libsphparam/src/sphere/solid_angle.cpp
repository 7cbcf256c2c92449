#include "sphere/solid_angle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sphere/difference_of_products.h"
#include "sphere/face_rays.h"
#include "sphparam/sphere/orientation.h"

namespace sphparam {
namespace {

/// By its angles (Girard), which are sure where two corners are nearly opposite and where all three
/// are near one great circle; the sign is the exact one.
double solid_angle_by_angles(const Vector3& a, const Vector3& b, const Vector3& c) {
  const std::array<Vector3, 3> rays = {a, b, c};
  const std::array<Vector3, 3> crosses = {near_cross(b, c), near_cross(c, a), near_cross(a, b)};
  const auto least = std::ranges::min_element(crosses, {}, &Vector3::squaredNorm) - crosses.begin();
  const double volume = std::abs(rays[least].dot(crosses[least]));
  double sum = -std::numbers::pi;
  for (int k = 0; k < 3; ++k)
    sum += elementary::atan2(volume, -crosses[(k + 1) % 3].dot(crosses[(k + 2) % 3]));
  return orientation(a, b, c) * sum;
}

/// Where sine and cosine are both next to nothing, or the sine's sign decides between 2π and −2π,
/// rounding would have the word.
double sure_solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  constexpr double unsure = 1e-3;
  const auto [sine, cosine] = half_solid_angle_of(a, b, c);
  if (cosine < unsure && std::abs(sine) < unsure) return solid_angle_by_angles(a, b, c);
  return 2 * elementary::atan2(sine, cosine);
}

}  // namespace

VectorX vertex_solid_angles(const Topology& topology, const SphereMap& map) {
  VectorX shares = VectorX::Zero(topology.vertex_count());
  for (Face f = 0; f < topology.face_count(); ++f) {
    const auto [a, b, c] = face_rays(topology, map, f);
    const double angle = sure_solid_angle(a, b, c);
    for (int k = 0; k < 3; ++k) shares[topology.vertex(f, k)] += angle / 3;
  }
  return shares;
}

}  // namespace sphparam
