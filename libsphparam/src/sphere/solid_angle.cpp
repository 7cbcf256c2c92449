#include "sphere/solid_angle.h"

#include <cmath>

#include "sphparam/sphere/orientation.h"

namespace sphparam {
namespace {

/// Of a triangle of next to half the sphere rounding would decide between 2π and −2π: the exact
/// sign does.
double surely_signed_solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  constexpr double rounding = 1e-14;  // of the sine
  const auto [sine, cosine] = half_solid_angle_of(a, b, c);
  if (cosine >= 0 || std::abs(sine) > rounding) return 2 * elementary::atan2(sine, cosine);
  return 2 * elementary::atan2(orientation(a, b, c) * std::abs(sine), cosine);
}

}  // namespace

VectorX vertex_solid_angles(const Topology& topology, const SphereMap& map) {
  VectorX shares = VectorX::Zero(topology.vertex_count());
  for (Face f = 0; f < topology.face_count(); ++f) {
    const double angle = surely_signed_solid_angle(map.point(topology.vertex(f, 0)),
                                                   map.point(topology.vertex(f, 1)),
                                                   map.point(topology.vertex(f, 2)));
    for (int k = 0; k < 3; ++k) shares[topology.vertex(f, k)] += angle / 3;
  }
  return shares;
}

}  // namespace sphparam
