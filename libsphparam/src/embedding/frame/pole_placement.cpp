#include "embedding/frame/pole_placement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "elementary.h"
#include "embedding/constructions/orientations.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/sweeps/relaxation.h"
#include "mesh/faces_around.h"
#include "mesh/rings.h"
#include "sphere/face_rays.h"
#include "sphparam/parallel.h"

// Stereographic projection from north = +z: w = (x + iy)/(1 − z), −z at the origin, and back
// (x, y, z) = (2w, |w|² − 1)/(|w|² + 1). The translation w ↦ w − t·w_south fixes north (infinity)
// and, for t = 1, takes south to −z.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 8192;
constexpr double smallest_part = 1e-3;  // of the way: below this a move counts as impossible
// Around a pole that was moved by less than an edge; and where layers of long thin triangles lie
// between it and its place.
constexpr int rings_to_settle[] = {3, 12};
constexpr int vertices_an_end = 32;     // of an axis, among which opposite ones are looked for
constexpr int pairs_tried = 8;

size_t at(std::int64_t i) { return static_cast<size_t>(i); }

/// The map with every point replaced.
template <class Move>
SphereMap moved(const SphereMap& map, int threads, const Move& move) {
  SphereMap result;
  result.points.resize(map.points.rows(), 3);
  parallel_for(map.points.rows(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto v = static_cast<Vertex>(first); v < static_cast<Vertex>(last); ++v) {
      result.points.row(v) = move(map.point(v));
    }
  });
  return result;
}

/// Rodrigues' formula for the shortest turn that takes the unit vector n to +z, about v = n × z:
/// x ↦ c x + v × x + (v·x) v / (1 + c), c = n·z. Written out, for matrix products may be
/// contracted.
class TurnToNorth {
 public:
  explicit TurnToNorth(const Vector3& n)
      : n_(n), share_(n.z() > 0 ? 1 / (1 + n.z()) : (1 - n.z()) / n.head<2>().squaredNorm()) {}

  Vector3 operator()(const Vector3& x) const {
    if (n_.x() == 0 && n_.y() == 0 && n_.z() > 0) return x;
    if (std::isinf(share_)) return {x.x(), -x.y(), -x.z()};  // −z, or nearer than |v|² can tell
    const double along = share_ * (n_.y() * x.x() - n_.x() * x.y());
    return {n_.z() * x.x() - n_.x() * x.z() + n_.y() * along,
            n_.z() * x.y() - n_.y() * x.z() - n_.x() * along,
            n_.z() * x.z() + n_.x() * x.x() + n_.y() * x.y()};
  }

 private:
  Vector3 n_;
  double share_;  // 1/(1 + c), in the south as (1 − c)/|v|²
};

SphereMap rotated_to_north(const SphereMap& map, Vertex north, int threads) {
  const TurnToNorth turn(map.point(north));
  SphereMap result =
      moved(map, threads, [&](const Vector3& x) -> Vector3 { return turn(x).normalized(); });
  result.points.row(north) = Vector3::UnitZ();
  return result;
}

Eigen::Vector2d to_plane(const Vector3& x) {
  // 1 − z without cancellation near the north: (x² + y²)/(1 + z).
  const double rr = x.head<2>().squaredNorm();
  const double depth = x.z() > 0 ? rr / (1 + x.z()) : 1 - x.z();
  return x.head<2>() / depth;
}

Vector3 to_sphere(const Eigen::Vector2d& w) {
  const double s = w.squaredNorm();
  return Vector3(2 * w.x(), 2 * w.y(), s - 1) / (s + 1);
}

SphereMap translated(const SphereMap& map, Vertex north, const Eigen::Vector2d& by, int threads) {
  SphereMap result = moved(map, threads, [&](const Vector3& x) -> Vector3 {
    return to_sphere(to_plane(x) - by).normalized();
  });
  result.points.row(north) = map.points.row(north);
  return result;
}

/// The energy of the triangles at some vertices.
double energy_around(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                     const std::vector<Vertex>& vertices, const DistortionEnergy& energy) {
  double sum = 0;
  for (const Face f : faces_around(topology, vertices)) {
    const RestTriangle& triangle = source[at(f)];
    const auto [d, s] = distortion(triangle, face_rays(topology, map, f));
    sum += triangle.area * energy_density(energy, d, s);
  }
  return sum;
}

/// Pairs of vertices near the two ends of an axis that share no edge, the most nearly opposite
/// ones first.
std::vector<std::pair<Vertex, Vertex>> opposite_pairs(const Topology& topology,
                                                      const SphereMap& map, const Vector3& axis,
                                                      std::optional<Vertex> no_pole, int threads) {
  struct Pair {
    double miss;  // |north + south|²
    Vertex north, south;
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  const std::vector<Vertex> souths = nearest_vertices(map, -axis, vertices_an_end, threads);
  for (const Vertex north : nearest_vertices(map, axis, vertices_an_end, threads)) {
    for (const Vertex south : souths) {
      pairs.push_back({(map.point(north) + map.point(south)).squaredNorm(), north, south});
    }
  }
  std::ranges::sort(pairs);
  std::vector<std::pair<Vertex, Vertex>> result;
  for (const auto& [miss, north, south] : pairs) {
    if (std::ssize(result) == pairs_tried) break;
    if (north == south || topology.find_halfedge(north, south) >= 0) continue;
    if (north == no_pole || south == no_pole) continue;
    result.push_back({north, south});
  }
  return result;
}

/// Moves the south pole to −z as far as it can, relaxing what is around it. The energy gained.
double bring_down(const Topology& topology, const RestTriangles& source,
                  const PolePlacementOptions& options, int rings, PolePlacement& placement) {
  const Vector3 down = -Vector3::UnitZ();
  const Vertex south = placement.south;
  SphereMap& map = placement.map;
  const std::vector<Vertex> around = rings_around(topology, {south}, rings);
  const double before = energy_around(topology, source, map, around, options.energy);
  for (double part = 1; map.point(south) != down && part > smallest_part;) {
    const Vector3 from = map.point(south);
    map.points.row(south) = part == 1 ? down : Vector3((from + part * (down - from)).normalized());
    if (ring_is_positive(topology, map, south)) {
      map = relax(topology, source, map,
                  {.energy = options.energy,
                   .sweeps = options.sweeps,
                   .vertices = around,
                   .pinned = {placement.north, south},
                   .threads = options.threads,
                   .measure_energy = false})
                .map;
      if (++placement.moves == options.most_moves) break;
      part = std::min(1.0, 4 * part);
    } else {
      map.points.row(south) = from;
      part /= 2;
    }
  }
  return before - energy_around(topology, source, map, around, options.energy);
}

void require_domain(const PolePlacementOptions& options) {
  require_domain(options.energy);
  require_at_least("sweeps", options.sweeps, 0);
  require_at_least("most_moves", options.most_moves, 1);
}

}  // namespace

std::vector<Vertex> nearest_vertices(const SphereMap& map, const Vector3& direction, int count,
                                     int threads) {
  using Candidate = std::pair<double, Vertex>;  // squared distance first
  const Vector3 target = direction.normalized();
  std::vector<std::vector<Candidate>> parts(at((map.points.rows() + grain - 1) / grain));
  parallel_for(map.points.rows(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    std::vector<Candidate>& heap = parts[at(first / grain)];  // the farthest on top
    for (auto v = static_cast<Vertex>(first); v < static_cast<Vertex>(last); ++v) {
      const Candidate candidate{(map.point(v) - target).squaredNorm(), v};
      if (std::ssize(heap) == count) {
        if (candidate >= heap.front()) continue;
        std::ranges::pop_heap(heap);
        heap.pop_back();
      }
      heap.push_back(candidate);
      std::ranges::push_heap(heap);
    }
  });
  std::vector<Candidate> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  std::ranges::sort(all);
  std::vector<Vertex> nearest;
  for (size_t i = 0; i < std::min(all.size(), at(count)); ++i) nearest.push_back(all[i].second);
  return nearest;
}

std::optional<PolePlacement> place_poles_on_axis(const Topology& topology,
                                                 const RestTriangles& source, const SphereMap& map,
                                                 const Vector3& axis,
                                                 const PolePlacementOptions& options) {
  require_domain(options);
  require_more_than("axis: squared length", axis.squaredNorm(), 0);
  const auto pairs = opposite_pairs(topology, map, axis, options.no_pole, options.threads);
  for (const int rings : rings_to_settle) {
    for (const auto& [north, south] : pairs) {
      report(options.progress, "poles", 0);
      PolePlacement result{
          .map = rotated_to_north(map, north, options.threads), .north = north, .south = south};
      const double gain = bring_down(topology, source, options, rings, result);
      if (result.map.point(south) != -Vector3::UnitZ()) continue;
      result.energy_before =
          distortion_energy(topology, source, map, options.energy, options.threads);
      result.energy_after = result.energy_before - gain;
      return result;
    }
  }
  return std::nullopt;
}

std::optional<PolePlacement> place_poles(const Topology& topology, const RestTriangles& source,
                                         const SphereMap& map, Vertex north, Vertex south,
                                         const PolePlacementOptions& options) {
  require_domain(options);
  require_vertex("north", north, topology.vertex_count());
  require_vertex("south", south, topology.vertex_count());
  PolePlacement result{
      .map = rotated_to_north(map, north, options.threads), .north = north, .south = south};
  result.energy_before = distortion_energy(topology, source, map, options.energy, options.threads);
  if (!all_triangles_positive(topology, result.map, options.threads)) return std::nullopt;

  const RelaxationOptions relaxation{.energy = options.energy,
                                     .sweeps = options.sweeps,
                                     .pinned = {north, south},
                                     .threads = options.threads};
  double part = 1;
  for (;;) {
    report(options.progress, "poles", 1 - part);
    const Eigen::Vector2d target = part * to_plane(result.map.point(south));
    SphereMap candidate = translated(result.map, north, target, options.threads);
    if (part == 1) candidate.points.row(south) = -Vector3::UnitZ();
    if (all_triangles_positive(topology, candidate, options.threads)) {
      result.map = std::move(candidate);
      if (part == 1) break;
      if (++result.moves == options.most_moves) return std::nullopt;
      result.map = relax(topology, source, result.map, relaxation).map;
      part = std::min(1.0, 4 * part);
    } else {
      part /= 2;
      if (part < smallest_part) return std::nullopt;
    }
  }
  ++result.moves;
  result.map = relax(topology, source, result.map, relaxation).map;
  result.energy_after =
      distortion_energy(topology, source, result.map, options.energy, options.threads);
  return result;
}

SphereMap turned_to_meridian(const SphereMap& map, Vertex meridian, int threads) {
  require_vertex("meridian", meridian, map.points.rows());
  const Vector3 origin = map.point(meridian);
  const double radius = elementary::hypot(origin.x(), origin.y());
  const double c = origin.x() / radius, s = origin.y() / radius;
  SphereMap result = moved(map, threads, [&](const Vector3& x) -> Vector3 {
    return {c * x.x() + s * x.y(), c * x.y() - s * x.x(), x.z()};
  });
  result.points.row(meridian) << radius, 0, origin.z();
  return result;
}

}  // namespace sphparam
