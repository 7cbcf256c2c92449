#include "sphparam/correspondence/likeness.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "correspondence/coarse_to_fine.h"
#include "correspondence/matchable.h"
#include "correspondence/near_places.h"
#include "number_text.h"
#include "sphparam/correspondence/surface_map.h"
#include "sphparam/measure/measurable.h"
#include "sphparam/mesh/vertex_areas.h"
#include "sphparam/parallel.h"
#include "sphparam/version.h"

// Two stages: a map of least distortion from a few anchors, which has no limb on the wrong side;
// then rounds in which each vertex goes as far towards its own place as its triangles allow.

namespace sphparam {
namespace {

constexpr double far_apart = 0.1;  // of the diagonal: half of a mesh there is another surface
constexpr int most_rounds = 100;
constexpr double least_progress = 1e-3;   // of a round, of what is left of the way
constexpr double tolerable_density = 20;  // of the energy, an isometry's is 2: no step goes beyond
constexpr double parts_of_way[] = {1, 0.5, 0.25, 0.125};
constexpr double in_place = 1e-9;  // radians

/// The value that half of the weight is at or below.
double weighted_median(const std::vector<double>& values, const VectorX& weights) {
  std::vector<size_t> order(values.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](size_t i) { return values[i]; });
  const double half = weights.sum() / 2;
  double below = 0;
  for (const size_t i : order)
    if ((below += weights[static_cast<Eigen::Index>(i)]) >= half) return values[i];
  return 0;
}

class Liker {
 public:
  Liker(const MappedMesh& mesh, const MappedMesh& other, const LikeOptions& options)
      : mesh_(mesh),
        other_(other),
        options_(options),
        target_(other),
        near_(near_places(mesh, other, options.threads)),
        areas_(vertex_areas(mesh.surface())),
        diagonal_(diagonal_of(other.mesh().positions)) {}

  Likeness run() {
    require_near();
    SphereMap map = settled(anchored());
    Likeness found{mesh_.with_map(std::move(map), {{"version", version},
                                                   {"method", "like"},
                                                   {"stage", "like"},
                                                   {"like", other_.name()},
                                                   {"verdict", "one-to-one"}})};
    measure(found);
    return found;
  }

 private:
  /// Each is where the other is: of what is far smaller all is near to a little of the other, and
  /// no map has its anchors there.
  void require_near() const {
    require_near(mesh_, other_, near_, areas_);
    require_near(other_, mesh_, near_places(other_, mesh_, options_.threads),
                 vertex_areas(other_.surface()));
  }

  void require_near(const MappedMesh& one, const MappedMesh& there, const NearPlaces& near,
                    const VectorX& areas) const {
    const double apart = weighted_median(near.away, areas) / diagonal_;
    if (apart <= far_apart) return;
    throw UnlikeSurfaces(one.name() + " is not where " + there.name() +
                         " is: half of it is more than " + percent(apart) +
                         " of the diagonal away; has one been moved or scaled?");
  }

  SphereMap anchored() const {
    std::optional<SphereMap> map = anchored_map(
        mesh_, target_, near_, {.threads = options_.threads, .progress = options_.progress});
    if (map) return *std::move(map);
    throw UnlikeSurfaces("no map of " + mesh_.name() + " was found under which it lies as " +
                         other_.name() + " does");
  }

  SphereMap settled(const SphereMap& start) const {
    const RestTriangles rest = measure_source(mesh_.mesh(), options_.threads);
    std::vector<Place> places;
    for (Vertex v = 0; v < start.points.rows(); ++v)
      places.push_back(target_.place(start.point(v)));
    const std::vector<char> none_held(places.size(), 0);
    MovingSurface surface(mesh_.topology(), rest, target_, none_held, std::move(places));
    double left = way_left(surface);
    for (int round = 0; round < most_rounds && left > 0; ++round) {
      report(options_.progress, "settling", static_cast<double>(round) / most_rounds);
      surface.for_each_in_turn(options_.threads, [&](Vertex v) { move(surface, v); });
      const double before = left;
      left = way_left(surface);
      if (!(before - left > least_progress * before)) break;
    }
    SphereMap map{Points(start.points.rows(), 3)};
    for (Vertex v = 0; v < map.points.rows(); ++v) map.points.row(v) = surface.place(v).direction;
    return map;
  }

  bool trusts(Vertex v) const { return near_.trusted[static_cast<size_t>(v)] != 0; }

  /// Σ area · (chord to the place)² of what is trusted.
  double way_left(const MovingSurface& surface) const {
    return parallel_sum(
        areas_.size(), options_.threads, [&](std::int64_t first, std::int64_t last) {
          double sum = 0;
          for (auto v = static_cast<Vertex>(first); v < last; ++v)
            if (trusts(v))
              sum +=
                  areas_[v] *
                  (surface.place(v).direction - near_.directions.row(v).transpose()).squaredNorm();
          return sum;
        });
  }

  void move(MovingSurface& surface, Vertex v) const {
    if (!trusts(v)) {
      surface.step(v, energy_);
      return;
    }
    const Vector3 from = surface.place(v).direction, to = near_.directions.row(v);
    if (from == to) return;
    const double limit =
        std::max(surface.ring_energy(v, surface.place(v), energy_), tolerable(surface, v));
    for (const double part : parts_of_way) {
      const Vector3 between = part == 1 ? to : Vector3((from + part * (to - from)).normalized());
      if (!between.allFinite()) continue;
      const Place place = target_.place(between);
      if (!(surface.ring_energy(v, place, energy_) <= limit)) continue;
      surface.set(v, place);
      return;
    }
  }

  double tolerable(const MovingSurface& surface, Vertex v) const {
    double area = 0;
    mesh_.topology().for_each_outgoing(
        v, [&](Halfedge h) { area += surface.rest()[static_cast<size_t>(h / 3)].area; });
    return tolerable_density * area;
  }

  void measure(Likeness& found) const {
    const std::vector<SurfacePoint> on = SurfaceMap(found.mapped, other_).forth(options_.threads);
    std::vector<double> apart(on.size());
    double in = 0, nowhere = 0, all = 0;  // all in one order, so that no share exceeds 1
    for (Vertex v = 0; v < areas_.size(); ++v) {
      apart[static_cast<size_t>(v)] =
          (position(other_.mesh(), on[static_cast<size_t>(v)]) - mesh_.mesh().position(v)).norm() /
          diagonal_;
      const double left =
          (found.mapped.map().point(v) - near_.directions.row(v).transpose()).norm();
      all += areas_[v];
      if (!trusts(v))
        nowhere += areas_[v];
      else if (left <= in_place)
        in += areas_[v];
    }
    found.in_place = in / all;
    found.nowhere = nowhere / all;
    found.median = weighted_median(apart, areas_);
    found.farthest = *std::ranges::max_element(apart);
  }

  const MappedMesh &mesh_, &other_;
  const LikeOptions& options_;
  const TargetSurface target_;
  const NearPlaces near_;
  const VectorX areas_;
  const double diagonal_;
  const ComposedEnergy energy_ = {};
};

}  // namespace

Likeness map_like(const MappedMesh& mesh, const MappedMesh& other, const LikeOptions& options) {
  require_area(mesh);
  require_area(other);
  return Liker(mesh, other, options).run();
}

std::string to_text(const Likeness& likeness) {
  std::string line =
      percent(likeness.in_place) + " of the area goes to where it is nearest; half is within " +
      percent(likeness.median) + " of the diagonal of what lies in its direction, all within " +
      percent(likeness.farthest);
  if (likeness.nowhere > 0)
    line += "; " + percent(likeness.nowhere) + " is nearest to what faces another way";
  return line;
}

}  // namespace sphparam
