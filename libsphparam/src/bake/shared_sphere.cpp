#include "bake/shared_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary.h"

// Even directions: the spiral of the golden angle, one turn of it a step, equal steps in z.

namespace sphparam {
namespace {

constexpr int even_directions = 4096;

Points spread_evenly() {
  Points directions(even_directions, 3);
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < even_directions; ++i) {
    const double z = 1 - (2 * i + 1.0) / even_directions, r = std::sqrt(1 - z * z);
    directions.row(i) << r * elementary::cos(i * golden_angle),
        r * elementary::sin(i * golden_angle), z;
  }
  return directions;
}

/// The points of a surface in these directions.
Points points_at(const MappedMesh& on, const Points& directions, int threads) {
  const std::vector<SurfacePoint> places = on.locator().locate_all(directions, threads);
  Points points = Points::Zero(directions.rows(), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const auto& [face, weights] = places[static_cast<size_t>(i)];
    for (int k = 0; k < 3; ++k)
      points.row(i) += weights[k] * on.mesh().positions.row(on.mesh().triangles(face, k));
  }
  return points;
}

double median_distance(const Points& a, const Points& b, double unit) {
  std::vector<double> distances(static_cast<size_t>(a.rows()));
  for (size_t i = 0; i < distances.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    distances[i] = (a.row(row) / unit - b.row(row) / unit).stableNorm();
  }
  const auto middle = distances.begin() + std::ssize(distances) / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace

double disagreement(const MappedMesh& high, const MappedMesh& low, int threads) {
  const Points& positions = high.mesh().positions;
  // Halved, that of the largest coordinates is a number too.
  const double diagonal =
      2 *
      (0.5 * positions.colwise().maxCoeff() - 0.5 * positions.colwise().minCoeff()).stableNorm();
  if (!(diagonal > 0)) return 0;
  const Points even = spread_evenly();
  const double at_vertices =
      median_distance(points_at(high, low.map().points, threads), low.mesh().positions, diagonal);
  return std::min(at_vertices, median_distance(points_at(high, even, threads),
                                               points_at(low, even, threads), diagonal));
}

}  // namespace sphparam
