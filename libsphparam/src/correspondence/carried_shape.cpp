#include "sphparam/correspondence/carried_shape.h"

#include <cmath>
#include <cstdint>

#include "correspondence/matchable.h"
#include "embedding/frame/nearest_rotation.h"
#include "io/attributes/shading_normals.h"
#include "mesh/triangle_geometry.h"
#include "option_domain.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/mesh/vertex_areas.h"
#include "sphparam/parallel.h"

// Corners of the carried triangles lie on the other surface, so that their own points are near it;
// what they miss is seen from that surface alone.

namespace sphparam {
namespace {

constexpr std::int64_t vertex_grain = 4096, fidelity_samples = 200'000;

Vector3 normal_at(const TriangleMesh& mesh, const Points& normals, const SurfacePoint& point) {
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
    sum += point.barycentric[k] * normals.row(mesh.triangles(point.face, k)).transpose();
  const double length = sum.norm();
  return length > 0 ? Vector3(sum / length) : Vector3::UnitZ();
}

Vector3 mean(const Points& points, const VectorX& weights) {
  return points.transpose() * weights / weights.sum();
}

}  // namespace

CarriedShape carried_shape(const SurfaceMap& map, int threads) {
  const std::vector<SurfacePoint> points = map.forth(threads);
  const TriangleMesh& other = map.to().mesh();
  const Points normals = shading_normals(map.to().file());
  CarriedShape shape{map.from().mesh(), Points(std::ssize(points), 3)};
  parallel_for(std::ssize(points), vertex_grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (auto v = static_cast<Vertex>(first); v < static_cast<Vertex>(last); ++v) {
                   const SurfacePoint& point = points[static_cast<size_t>(v)];
                   shape.mesh.positions.row(v) = position(other, point);
                   shape.normals.row(v) = normal_at(other, normals, point);
                 }
               });
  return shape;
}

Similarity placement_on(const SurfaceMap& map, Placement placement, int threads) {
  Similarity result;
  require_one_of("placement", placement, Placement::Scaled);
  if (placement == Placement::AsItIs) return result;
  require_area(map.from());
  require_area(map.to());
  const Points& here = map.from().mesh().positions;
  const Points there = map.from_on_to(threads).positions;
  const VectorX weights = vertex_areas(map.from().surface());
  const double area = surface_area(map.from().surface()), other = surface_area(map.to().surface());
  const Vector3 middle = mean(here, weights), other_middle = mean(there, weights);
  result.rotation = nearest_rotation(there.rowwise() - other_middle.transpose(),
                                     here.rowwise() - middle.transpose(), weights / area);
  if (placement == Placement::Scaled) result.scale = std::sqrt(area / other);
  result.shift = middle - result.scale * (result.rotation * other_middle);
  return result;
}

CarriedFidelity measure_carried(const SurfaceMap& map, int threads, const Progress& progress) {
  const TriangleMesh carried{map.from_on_to(threads).positions, map.from().surface().triangles};
  const TriangleMesh& other = map.to().surface();
  const SurfaceDistance distance = measure_distance(
      other, carried, {.samples = fidelity_samples, .threads = threads, .progress = progress});
  return {.farthest = distance.forth.max / distance.diagonal_first,
          .rms = distance.forth.rms / distance.diagonal_first,
          .area_share = surface_area(carried) / surface_area(other)};
}

}  // namespace sphparam
