#include "sphparam/chart/tangent_frame.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>
#include <tuple>

#include "elementary.h"
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

/// Of two angles, sines and cosines times a positive number.
struct TwoAngles {
  std::array<double, 2> sines = {0, 0}, cosines = {1, 1};

  void set(size_t i, const Vector3& a, const Vector3& b) {
    sines[i] = a.cross(b).norm();
    cosines[i] = a.dot(b);
  }
};

/// Whether products of a few such numbers stay in the range of doubles.
bool is_usual(double size) { return size > 0x1p-200 && size < 0x1p200; }

/// v / |v|, or zero; for any finite v.
Vector3 direction_of(const Vector3& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  if (is_usual(largest)) return v.normalized();
  return largest > 0 ? Vector3((v / largest).normalized()) : Vector3(Vector3::Zero());
}

/// The direction of a triangle, and what its angles at corners 0 and 1 are made of.
Vector3 direction_along(const SphericalChart& chart, const Points& positions, Face f,
                        TwoAngles& angles) {
  std::array<Vector3, 3> edges;  // from corner k to the next
  for (int k = 0; k < 3; ++k)
    edges[k] =
        positions.row(chart.triangles(f, (k + 1) % 3)) - positions.row(chart.triangles(f, k));
  double largest = 0;
  for (const Vector3& e : edges) largest = std::max(largest, e.cwiseAbs().maxCoeff());
  if (largest == 0) return Vector3::Zero();
  if (!is_usual(largest)) {
    for (Vector3& e : edges) e /= largest;
  }

  const Eigen::Vector2d a = chart.uv.row(chart.wedges(f, 0));
  const Eigen::Vector2d first = chart.uv.row(chart.wedges(f, 1)).transpose() - a,
                        second = chart.uv.row(chart.wedges(f, 2)).transpose() - a;
  const double area = first[0] * second[1] - second[0] * first[1];
  const double sign = area > 0 ? 1 : -1;  // −: not folded
  // Angles, so that it does not matter how finely a triangle is split; they sum to π.
  angles.set(0, edges[0], -edges[2]);
  angles.set(1, edges[1], -edges[0]);
  // e₂ = −edges[2]
  return direction_of(sign * (second[1] * edges[0] + first[1] * edges[2]));
}

/// Of triangles first, first + 1, …; arctangents of some at once.
void find_directions(const SphericalChart& chart, const Points& positions, Face first,
                     std::span<CornerDirections> directions) {
  constexpr size_t most = 64;
  std::array<double, 2 * most> sines, cosines, angles;
  for (size_t begin = 0; begin < directions.size(); begin += most) {
    const auto some = directions.subspan(begin, std::min(most, directions.size() - begin));
    for (size_t i = 0; i < some.size(); ++i) {
      TwoAngles two;
      some[i].along = direction_along(chart, positions, first + static_cast<Face>(begin + i), two);
      std::ranges::copy(two.sines, &sines[2 * i]);
      std::ranges::copy(two.cosines, &cosines[2 * i]);
    }
    elementary::atan2(std::span(sines).first(2 * some.size()),
                      std::span(cosines).first(2 * some.size()),
                      std::span(angles).first(2 * some.size()));
    for (size_t i = 0; i < some.size(); ++i) {
      const double a = angles[2 * i], b = angles[2 * i + 1];
      some[i].angles = {a, b, std::max(0.0, std::numbers::pi - a - b)};
    }
  }
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

/// The directions about each wedge, longer where corners are wider. Wedges of a pole's fan have
/// sums of their own, others those of all that are alike.
class DirectionSums {
 public:
  DirectionSums(const SphericalChart& chart, const Points& normals,
                const std::vector<CornerDirections>& directions)
      : chart_(chart), sum_of_(sums_of(chart, normals)) {
    for (Face f = 0; f < static_cast<Face>(directions.size()); ++f) {
      const CornerDirections& corners = directions[static_cast<size_t>(f)];
      for (int k = 0; k < 3; ++k)
        row_of(chart.wedges(f, k)) += corners.angles[static_cast<size_t>(k)] * corners.along;
    }
  }

  Vector3 of(int wedge) const {
    return is_fan(wedge) ? fans_.row(wedge) : shared_.row(sum_of_[static_cast<size_t>(wedge)]);
  }

 private:
  bool is_fan(int wedge) const {
    return chart_.wedge_kinds[static_cast<size_t>(wedge)] == WedgeKind::PoleFan;
  }
  Points::RowXpr row_of(int wedge) {
    return is_fan(wedge) ? fans_.row(wedge) : shared_.row(sum_of_[static_cast<size_t>(wedge)]);
  }

  const SphericalChart& chart_;
  const std::vector<int> sum_of_;
  Points shared_ = Points::Zero(chart_.wedge_count(), 3), fans_ = shared_;
};

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
  std::vector<CornerDirections> directions(static_cast<size_t>(faces));
  parallel_for(faces, chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
    find_directions(chart, positions, static_cast<Face>(first),
                    std::span(directions)
                        .subspan(static_cast<size_t>(first), static_cast<size_t>(last - first)));
  });

  const DirectionSums sums(chart, normals, directions);
  ShadingFrame frame{Points(wedges, 3), Tangents(wedges, 4)};
  parallel_for(wedges, chunk_size, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto w = static_cast<int>(first); w < static_cast<int>(last); ++w) {
      const Vertex v = chart.wedge_vertices[static_cast<size_t>(w)];
      const Vector3 normal = normals.row(of_wedges ? w : v);
      const Vector3 sum = sums.of(w);
      frame.normals.row(w) = normal;
      frame.tangents.row(w) << tangent_of(sum, normal).transpose(), 1;
    }
  });
  return frame;
}

}  // namespace sphparam
