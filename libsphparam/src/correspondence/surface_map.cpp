#include "sphparam/correspondence/surface_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "correspondence/composed_energy.h"
#include "correspondence/target_surface.h"
#include "mesh/flat_face.h"
#include "mesh/triangle_geometry.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/parallel.h"

// σ of J = (x, y): σ² are the eigenvalues of JᵀJ, so σ₁² + σ₂² = |x|² + |y|², σ₁σ₂ = |x × y|.

namespace sphparam {
namespace {

constexpr std::int64_t face_grain = 1024;

double angle_at(const ImageTriangle& x, int corner) {
  const auto point = [&](int k) { return x[static_cast<size_t>((corner + k) % 3)]; };
  return angle_between(point(1) - point(0), point(2) - point(0));
}

/// Scaled to where the surface, without fillers, has the area of the sphere.
RestTriangles source_of(const MappedMesh& mapped, int threads) {
  RestTriangles rest = measure_source(mapped.mesh(), threads);
  const FillerMarks& fillers = mapped.fillers();
  if (fillers.empty()) return rest;
  double area = 0;
  for (size_t f = 0; f < rest.size(); ++f) area += fillers[f] ? 0 : rest[f].area;
  for (RestTriangle& triangle : rest) triangle = scaled(triangle, 4 * std::numbers::pi / area);
  return rest;
}

/// The larger one first; the smaller one without cancellation.
std::pair<double, double> singular_values(const Jacobian& j) {
  const double squares = j.x.squaredNorm() + j.y.squaredNorm();
  const double product = j.x.cross(j.y).norm();
  const double difference = std::sqrt(std::max(0.0, squares - 2 * product));
  const double most = (std::sqrt(squares + 2 * product) + difference) / 2;
  return {most, most > 0 ? product / most : 0};
}

}  // namespace

std::vector<SurfacePoint> SurfaceMap::forth(int threads) const {
  return to_.locator().locate_all(from_.map().points, threads);
}

Vector3 position(const TriangleMesh& mesh, const SurfacePoint& point) {
  Vector3 sum = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
    sum += point.barycentric[k] * mesh.position(mesh.triangles(point.face, k));
  return sum;
}

std::vector<double> values_at(const TriangleMesh& mesh, const std::vector<double>& values,
                              const std::vector<SurfacePoint>& points) {
  std::vector<double> result;
  for (const SurfacePoint& point : points) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double weight = point.barycentric[k];  // 0 keeps what is no number away
      if (weight != 0) sum += weight * values[static_cast<size_t>(mesh.triangles(point.face, k))];
    }
    result.push_back(sum);
  }
  return result;
}

TriangleMesh SurfaceMap::from_on_to(int threads) const {
  TriangleMesh result = from_.mesh();
  const std::vector<SurfacePoint> points = forth(threads);
  for (Vertex v = 0; v < result.vertex_count(); ++v)
    result.positions.row(v) = position(to_.mesh(), points[static_cast<size_t>(v)]);
  return result;
}

Distortion measure_distortion(const SurfaceMap& map, int threads) {
  const TriangleMesh& mesh = map.from().mesh();
  const FillerMarks& fillers = map.from().fillers();
  const Points from = scaled_to_sphere(map.from().surface());
  const TriangleMesh to{scaled_to_sphere(map.to().surface()), map.to().mesh().triangles};
  const std::vector<SurfacePoint> points = map.forth(threads);
  const RestTriangles rest = source_of(map.from(), threads);
  const Eigen::Index count = mesh.face_count();
  Distortion d{VectorX(count), RowTable<double, 3>(count, 3), VectorX(count), VectorX(count),
               VectorX(count)};
  parallel_for(count, face_grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (Eigen::Index f = first; f < last; ++f) {
      ImageTriangle before, after;
      for (int k = 0; k < 3; ++k) {
        const Vertex v = mesh.triangles(f, k);
        before[static_cast<size_t>(k)] = from.row(v);
        after[static_cast<size_t>(k)] = position(to, points[static_cast<size_t>(v)]);
      }
      const RestTriangle& triangle = rest[static_cast<size_t>(f)];
      const auto [most, least] = singular_values(jacobian(triangle, after));
      d.sigma_max[f] = most;
      d.sigma_min[f] = least;
      d.area_ratio[f] = triangle_area(after[0], after[1], after[2]) / triangle.area;
      const bool counts = fillers.empty() || !fillers[static_cast<size_t>(f)];
      d.source_area[f] = counts && !is_flat(before[0], before[1], before[2]) ? triangle.area : 0;
      for (int k = 0; k < 3; ++k) d.angle_ratio(f, k) = angle_at(after, k) / angle_at(before, k);
    }
  });
  if (const double total = d.source_area.sum(); total > 0) d.source_area /= total;
  return d;
}

DistortionSummary summarise_distortion(const SurfaceMap& map, int threads) {
  DistortionSummary summary = summarise(measure_distortion(map, threads), threads);
  const FillerMarks& fillers = map.from().fillers();
  summary.flat_faces -= std::ranges::count_if(fillers, [](unsigned char mark) { return mark; });
  return summary;
}

}  // namespace sphparam
