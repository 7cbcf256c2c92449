#include "embedding/sweeps/rest_ring.h"

#include <cmath>
#include <limits>

#include "embedding/energy/orientation_guard.h"

namespace sphparam {
namespace {

constexpr double narrow = 100;  // energy of an isometry: more is a ring without room

}  // namespace

RestRing::RestRing(const std::vector<Vector3>& edges, const RestFloors& floors) {
  for (size_t i = 0; i < edges.size(); ++i) {
    triangles_.push_back(rest_triangle(edges[i], edges[(i + 1) % edges.size()], floors));
  }
}

double RestRing::energy(const DistortionEnergy& energy, const std::vector<Vector3>& ring,
                        const Vector3& x) const {
  double sum = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector3 &p = ring[i], &q = ring[(i + 1) % ring.size()], a = p - x, b = q - x;
    if (!certainly_positive(x.dot(a.cross(b)) / 2, a.squaredNorm() + b.squaredNorm())) {
      return std::numeric_limits<double>::infinity();
    }
    const auto [d, s] = distortion(triangles_[i], {x, p, q});
    sum += triangles_[i].area * energy_density(energy, d, s);
  }
  return sum;
}

bool RestRing::is_narrow(const DistortionEnergy& energy, double value) const {
  double area = 0;
  for (const RestTriangle& triangle : triangles_) area += triangle.area;
  return !(value < narrow * energy_density(energy, 1, 1) * area);
}

Vector3 RestRing::mean_value_point(const std::vector<Vector3>& ring) const {
  Vector3 sum = Vector3::Zero();
  for (size_t i = 0; i < ring.size(); ++i) {
    const RestTriangle& t = triangles_[i];
    const double height = 1 / t.inverse_height, base = 1 / t.inverse_base, foot = t.foot * base;
    const double side = std::sqrt(foot * foot + height * height), along = std::abs(foot) + side;
    const double half_angle = foot > 0 ? height / along : along / height;
    sum += half_angle * (ring[i] / base + ring[(i + 1) % ring.size()] / side);
  }
  return sum.stableNormalized();
}

}  // namespace sphparam
