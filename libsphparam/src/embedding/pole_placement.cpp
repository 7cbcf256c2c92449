#include "sphparam/embedding/pole_placement.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "sphparam/embedding/relaxation.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// Stereographic projection from north = +z: w = (x + iy)/(1 − z), −z at the origin, and back
// (x, y, z) = (2w, |w|² − 1)/(|w|² + 1). The translation w ↦ w − t·w_south fixes north (infinity)
// and, for t = 1, takes south to −z.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 8192;
constexpr double smallest_part = 1e-3;  // of the way: below this a move counts as impossible

bool all_positive(const Topology& topology, const SphereMap& map, int threads) {
  std::atomic<bool> positive{true};
  parallel_for(topology.face_count(), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto f = static_cast<Face>(first); f < static_cast<Face>(last) && positive; ++f) {
      if (orientation(map.point(topology.vertex(f, 0)), map.point(topology.vertex(f, 1)),
                      map.point(topology.vertex(f, 2))) <= 0) {
        positive = false;
      }
    }
  });
  return positive;
}

SphereMap rotated_to_north(const SphereMap& map, Vertex north) {
  const Eigen::Matrix3d rotation =
      Eigen::Quaterniond::FromTwoVectors(map.point(north), Vector3::UnitZ()).toRotationMatrix();
  SphereMap result = normalised(map.points * rotation.transpose());
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

SphereMap translated(const SphereMap& map, Vertex north, const Eigen::Vector2d& by) {
  SphereMap result = map;
  for (Vertex v = 0; v < static_cast<Vertex>(map.points.rows()); ++v) {
    if (v == north) continue;
    const Vector3 x = to_sphere(to_plane(map.point(v)) - by);
    result.points.row(v) = x.normalized();
  }
  return result;
}

}  // namespace

std::optional<PolePlacement> place_poles(const Topology& topology, const SourceTriangles& source,
                                         const SphereMap& map, Vertex north, Vertex south,
                                         const PolePlacementOptions& options) {
  PolePlacement result;
  result.energy_before = distortion_energy(topology, source, map, options.energy, options.threads);
  result.map = rotated_to_north(map, north);
  if (!all_positive(topology, result.map, options.threads)) return std::nullopt;

  RelaxationOptions relaxation{.energy = options.energy,
                               .sweeps = options.sweeps,
                               .pinned = {north, south},
                               .threads = options.threads};
  double part = 1;
  for (;;) {
    report(options.progress, "poles", 1 - part);
    const Eigen::Vector2d target = part * to_plane(result.map.point(south));
    SphereMap moved = translated(result.map, north, target);
    if (part == 1) moved.points.row(south) = -Vector3::UnitZ();
    if (all_positive(topology, moved, options.threads)) {
      result.map = std::move(moved);
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

}  // namespace sphparam
