#include "sphparam/chart/tangent_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "mesh/triangle_geometry.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/parallel.h"

// On a triangle with edges e₁, e₂ and their (u₁, v₁), (u₂, v₂) the surface grows with u along
//   ∂p/∂u = (v₂ e₁ − v₁ e₂) / (u₁ v₂ − u₂ v₁),
// of which only the direction matters. Its sums are per refined vertex and normal there, which
// welds the seam and keeps hard edges; a pole fan's wedge belongs to one triangle and takes that
// one's. Faces in parallel, sums in the order of the faces, wedges in parallel.

namespace sphparam {
namespace {

constexpr std::int64_t chunk_size = 8192;

/// What a triangle adds to the sums at its corners: a unit direction times the angles there.
struct CornerDirections {
  Vector3 along = Vector3::Zero();
  std::array<double, 3> angles = {0, 0, 0};
};

/// v / |v|, or zero; for any finite v.
Vector3 direction_of(const Vector3& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  return largest > 0 ? Vector3((v / largest).normalized()) : Vector3(Vector3::Zero());
}

CornerDirections corner_directions(const SphericalChart& chart, const Points& positions, Face f) {
  std::array<Vector3, 3> edges;  // from corner k to the next
  for (int k = 0; k < 3; ++k)
    edges[k] =
        positions.row(chart.triangles(f, (k + 1) % 3)) - positions.row(chart.triangles(f, k));
  // The largest is 1, so that no product leaves the range of doubles.
  double scale = 0;
  for (const Vector3& e : edges) scale = std::max(scale, e.cwiseAbs().maxCoeff());
  if (scale == 0) return {};
  for (Vector3& e : edges) e /= scale;

  const Eigen::Vector2d a = chart.uv.row(chart.wedges(f, 0));
  const Eigen::Vector2d first = chart.uv.row(chart.wedges(f, 1)).transpose() - a,
                        second = chart.uv.row(chart.wedges(f, 2)).transpose() - a;
  const double area = first[0] * second[1] - second[0] * first[1];
  const double sign = area > 0 ? 1 : -1;  // −: not folded
  // e₂ = −edges[2]
  const Vector3 along = direction_of(sign * (second[1] * edges[0] + first[1] * edges[2]));
  // Angles, so that it does not matter how finely a triangle is split; they sum to π.
  const double at_first = angle_between(edges[0], -edges[2]),
               at_second = angle_between(edges[1], -edges[0]);
  const double at_third = std::max(0.0, std::numbers::pi - at_first - at_second);
  return {along, {at_first, at_second, at_third}};
}

/// A unit vector in the plane of the normal, as near to `sum` as can be.
Vector3 tangent_of(const Vector3& sum, const Vector3& normal) {
  const Vector3 along = direction_of(sum);
  const Vector3 flat = along - along.dot(normal) * normal;
  // Less is rounding of a sum along the normal, or no sum at all.
  constexpr double no_direction = 1e-8;
  if (flat.norm() < no_direction) return normal.unitOrthogonal();
  const Vector3 unit = flat.normalized();
  return (unit - unit.dot(normal) * normal).normalized();
}

Eigen::Index vertices_of(const SphericalChart& chart) {
  return static_cast<Eigen::Index>(chart.surface_points.size());
}

/// Of each wedge, the first wedge of its vertex that has its normal.
std::vector<int> first_alike(const SphericalChart& chart, const Points& wedge_normals) {
  std::vector<int> order(chart.wedge_vertices.size()), first(order.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int w) {
    const auto n = wedge_normals.row(w);
    return std::tuple(chart.wedge_vertices[static_cast<size_t>(w)], n[0], n[1], n[2]);
  };
  std::ranges::stable_sort(order, {}, key);
  for (size_t i = 0; i < order.size(); ++i) {
    const bool alike = i > 0 && key(order[i]) == key(order[i - 1]);
    first[static_cast<size_t>(order[i])] =
        alike ? first[static_cast<size_t>(order[i - 1])] : order[i];
  }
  return first;
}

/// Of each wedge, which sum is its own: that of its vertex, or of its normal there.
std::vector<int> sums_of(const SphericalChart& chart, const Points& normals) {
  const bool of_wedges = normals.rows() == chart.wedge_count();
  return of_wedges ? first_alike(chart, normals) : chart.wedge_vertices;
}

void require_rows(bool right) {
  if (!right) throw std::invalid_argument("tangent_frame: not one row a refined vertex or wedge");
}

}  // namespace

Points carry_normals(const SphericalChart& chart, const Triangles& source, const Points& normals,
                     int threads) {
  Points carried = carry_vertex_attribute(chart, source, normals, threads);
  parallel_for(carried.rows(), chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t v = first; v < last; ++v) {
      const Vector3 unit = direction_of(carried.row(v));
      carried.row(v) = unit.isZero(0) ? Vector3(Vector3::UnitZ()) : unit;
    }
  });
  return carried;
}

ShadingFrame tangent_frame(const SphericalChart& chart, const Points& positions,
                           const Points& normals, int threads) {
  const Eigen::Index faces = chart.triangles.rows(), wedges = chart.wedge_count();
  require_rows(positions.rows() == vertices_of(chart));
  require_rows(normals.rows() == vertices_of(chart) || normals.rows() == wedges);
  const bool of_wedges = normals.rows() == wedges;
  const std::vector<int> sum_of = sums_of(chart, normals);
  std::vector<CornerDirections> directions(static_cast<size_t>(faces));
  parallel_for(faces, chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f)
      directions[static_cast<size_t>(f)] = corner_directions(chart, positions, f);
  });

  const auto is_fan = [&](int w) {
    return chart.wedge_kinds[static_cast<size_t>(w)] == WedgeKind::PoleFan;
  };
  Points sums = Points::Zero(wedges, 3), fans = Points::Zero(wedges, 3);
  for (Face f = 0; f < static_cast<Face>(faces); ++f) {
    const CornerDirections& corners = directions[static_cast<size_t>(f)];
    for (int k = 0; k < 3; ++k) {
      const int w = chart.wedges(f, k);
      const Vector3 direction = corners.angles[static_cast<size_t>(k)] * corners.along;
      is_fan(w) ? fans.row(w) += direction : sums.row(sum_of[static_cast<size_t>(w)]) += direction;
    }
  }

  ShadingFrame frame{Points(wedges, 3), Tangents(wedges, 4)};
  parallel_for(wedges, chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto w = static_cast<int>(first); w < static_cast<int>(last); ++w) {
      const Vertex v = chart.wedge_vertices[static_cast<size_t>(w)];
      const Vector3 normal = normals.row(of_wedges ? w : v);
      const Vector3 sum = is_fan(w) ? fans.row(w) : sums.row(sum_of[static_cast<size_t>(w)]);
      frame.normals.row(w) = normal;
      frame.tangents.row(w) << tangent_of(sum, normal).transpose(), 1;
    }
  });
  return frame;
}

}  // namespace sphparam
