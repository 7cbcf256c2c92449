#include "correspondence/near_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/vertex_normals.h"
#include "rays/ray_scene.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

constexpr double same_way = 0.5;      // cosine of the angle between normals, at least
constexpr double far_from_usual = 2;  // times the median: no anchor
constexpr double far_apart = 0.1;     // of the diagonal
constexpr std::int64_t grain = 64;
constexpr int anchor_counts[] = {16, 8, 4, 3};  // the first that a map is found with
constexpr int all_starts = 3;

/// Not a number, or 0, where a face has no area: it faces no way.
Vector3 normal_of(const TriangleMesh& mesh, Face f) {
  const auto corner = [&](int k) { return mesh.position(mesh.triangles(f, k)); };
  return (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
}

Vector3 direction_of(const MappedMesh& mapped, const SurfacePoint& on) {
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
    sum += on.barycentric[k] * mapped.map().point(mapped.mesh().triangles(on.face, k));
  return sum.normalized();
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

NearPlaces near_places(const MappedMesh& mesh, const MappedMesh& other, int threads) {
  const RayScene scene(other.mesh());
  const Points normals = angle_weighted_normals(mesh.mesh());
  const Vertex count = mesh.mesh().vertex_count();
  NearPlaces near{Points(count, 3), std::vector<double>(static_cast<size_t>(count)),
                  std::vector<char>(static_cast<size_t>(count))};
  parallel_for(count, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto v = static_cast<Vertex>(first); v < last; ++v) {
      const NearestPoint found = scene.nearest(mesh.mesh().position(v));
      const Vector3 direction = direction_of(other, found.on);
      near.directions.row(v) = direction;
      near.away[static_cast<size_t>(v)] = std::sqrt(found.squared_distance);
      near.trusted[static_cast<size_t>(v)] =
          direction.allFinite() &&
          normal_of(other.mesh(), found.on.face).dot(normals.row(v)) > same_way;
    }
  });
  return near;
}

bool is_there(const NearPlaces& near, double diagonal) {
  return median_of(near.away) <= far_apart * diagonal;
}

std::vector<Vertex> spread_anchors(const TriangleMesh& mesh, const NearPlaces& near, int most) {
  std::vector<double> trusted;
  for (size_t v = 0; v < near.away.size(); ++v)
    if (near.trusted[v]) trusted.push_back(near.away[v]);
  const double limit = far_from_usual * median_of(trusted);
  const auto usable = [&](Vertex v) {
    return near.trusted[static_cast<size_t>(v)] && near.away[static_cast<size_t>(v)] <= limit;
  };
  const Vector3 middle = mesh.positions.colwise().mean();
  std::vector<double> apart(near.away.size());  // from the middle, then from all anchors
  for (Vertex v = 0; v < mesh.vertex_count(); ++v)
    apart[static_cast<size_t>(v)] = (mesh.position(v) - middle).norm();
  std::vector<Vertex> anchors;
  while (std::ssize(anchors) < most) {
    Vertex next = -1;
    for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
      const double most_apart = next < 0 ? 0 : apart[static_cast<size_t>(next)];
      if (usable(v) && apart[static_cast<size_t>(v)] > most_apart) next = v;
    }
    if (next < 0) break;
    if (anchors.empty()) std::ranges::fill(apart, std::numeric_limits<double>::infinity());
    anchors.push_back(next);
    for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
      double& least = apart[static_cast<size_t>(v)];
      least = std::min(least, (mesh.position(v) - mesh.position(next)).norm());
    }
  }
  return anchors;
}

std::optional<SphereMap> anchored_map(const MappedMesh& mesh, const TargetSurface& target,
                                      const NearPlaces& near, ComposedOptions options) {
  options.release = true;
  for (const int count : anchor_counts) {
    options.landmarks.clear();
    for (const Vertex v : spread_anchors(mesh.mesh(), near, count))
      options.landmarks.push_back({v, near.directions.row(v)});
    CoarseToFine way(mesh.mesh(), mesh.topology(), target, options);
    if (!way.start(all_starts)) continue;
    SphereMap map = way.finish();
    if (map.points.rows() > 0) return map;
  }
  return std::nullopt;
}

}  // namespace sphparam
