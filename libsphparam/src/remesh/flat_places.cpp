// From the triangle that the ray meets to the nearest of those that share a vertex with it, until
// none is nearer. The first of several that are as near is kept, the one at hand before all others.

#include "remesh/flat_places.h"

#include "rays/triangle_distance.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 4096;

class Facets {
 public:
  Facets(const Topology& topology, const SphereMap& map) : topology_(topology), map_(map) {}

  SurfacePoint nearest(const Vector3& p, Face start) const {
    TrianglePoint best = on_face(p, start);
    Face at = start;
    for (Face from = -1; from != at;) {
      from = at;
      for (int k = 0; k < 3; ++k) {
        topology_.for_each_outgoing(topology_.vertex(from, k), [&](Halfedge h) {
          const TrianglePoint other = on_face(p, Topology::face(h));
          if (!(other.squared_distance < best.squared_distance)) return;
          best = other;
          at = Topology::face(h);
        });
      }
    }
    return {at, best.barycentric};
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
