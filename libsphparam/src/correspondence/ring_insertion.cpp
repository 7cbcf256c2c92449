#include "correspondence/ring_insertion.h"

#include <algorithm>

// Mean value coordinates of the vertex in its ring on the source, wᵢ = (tan αᵢ₋₁/2 + tan αᵢ/2)/|eᵢ|
// (Floater 2003), give a point in space between the ring's positions on the target. A walk
// approaches the point of the target that is nearest to it.

namespace sphparam {
namespace {

constexpr int approaches = 4;
constexpr double most_tangent = 1e6, least_length = 1e-12;

/// tan of half the angle.
double half_tangent(const Vector3& a, const Vector3& b) {
  const double sine = a.cross(b).norm(), cosine = a.dot(b), unit = a.norm() * b.norm();
  return std::min(most_tangent, sine / std::max(unit + cosine, sine / most_tangent + 1e-300));
}

/// Where the ring's weights have the vertex on the target.
Vector3 wanted_position(const MovingSurface& surface, const HierarchyLevel& level, Vertex v) {
  const int count = level.valence(v);
  const Vertex* ring = level.ring_begin(v);
  const auto edge = [&](int i) -> Vector3 {
    return level.positions.row(ring[(i + count) % count]) - level.positions.row(v);
  };
  Vector3 sum = Vector3::Zero();
  double weights = 0;
  for (int i = 0; i < count; ++i) {
    const Vector3 e = edge(i);
    const double weight = (half_tangent(edge(i - 1), e) + half_tangent(e, edge(i + 1))) /
                          std::max(least_length, e.norm());
    sum += weight * surface.place(ring[i]).position;
    weights += weight;
  }
  return weights > 0 ? Vector3(sum / weights) : surface.place(v).position;
}

}  // namespace

void put_into_ring(MovingSurface& surface, const HierarchyLevel& level, Vertex v,
                   const ComposedEnergy& energy) {
  const Vector3 wanted = wanted_position(surface, level, v);
  Place best = surface.place(v);
  double least = surface.ring_energy(v, best, energy);
  const auto walk_from = [&](Place at) {
    for (int i = 0; i < approaches; ++i) {
      const Vector3 way = wanted - at.position;
      at = surface.target().walk(
          at, way.dot(at.frame.u) * at.frame.u + way.dot(at.frame.v) * at.frame.v);
      const double there = surface.ring_energy(v, at, energy);
      if (!(there < least)) continue;
      least = there;
      best = at;
    }
  };
  walk_from(best);
  for (int i = 0; i < level.valence(v); ++i) walk_from(surface.place(level.ring_begin(v)[i]));
  surface.set(v, best);
}

}  // namespace sphparam
