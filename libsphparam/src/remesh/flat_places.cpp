// From the triangle that the ray meets to the nearest of those that share a vertex with it, until
// none is nearer. The first of several that are as near is kept, the one at hand before all others.

#include "remesh/flat_places.h"

#include "rays/triangle_distance.h"
#include "remesh/walk_to_nearest.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 4096;

class Facets {
 public:
  Facets(const Topology& topology, const SphereMap& map) : topology_(topology), map_(map) {}

  SurfacePoint nearest(const Vector3& p, Face start) const {
    const auto [face, point] = walk_to_nearest(
        topology_, start, [&](Face f) { return on_face(p, f); },
        [](const TrianglePoint& other, Face, const TrianglePoint& best, Face) {
          return other.squared_distance < best.squared_distance;
        });
    return {face, point.barycentric};
  }

 private:
  TrianglePoint on_face(const Vector3& p, Face face) const {
    const auto corner = [&](int k) -> Vector3 { return map_.point(topology_.vertex(face, k)); };
    return nearest_on_triangle(p, corner(0), corner(1), corner(2));
  }

  const Topology& topology_;
  const SphereMap& map_;
};

}  // namespace

std::vector<SurfacePoint> nearest_on_facets(const Topology& topology, const SphereMap& map,
                                            const Points& directions,
                                            std::vector<SurfacePoint> located, int threads) {
  const Facets facets(topology, map);
  parallel_for(std::ssize(located), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      SurfacePoint& place = located[static_cast<std::size_t>(i)];
      if (place.barycentric.maxCoeff() == 1) continue;
      const Vector3 direction = directions.row(i);
      place = facets.nearest(direction.normalized(), place.face);
    }
  });
  return located;
}

}  // namespace sphparam
