#include "level_set.h"

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "sphparam/parallel.h"

// Lattice points are the corners and the centres of cubes. Two centres across a common face make,
// with each of the face's four sides, a tetrahedron; these fill space, all alike and nearly
// regular. Every tetrahedron whose corners differ in sign adds one or two triangles between the
// points where its edges cross zero; neighbours share those points, so the surface is closed.

namespace sphparam::samples {
namespace {

constexpr int margin = 2;  // cubes around the box, so that the tetrahedra fill it

using Tetrahedron = std::array<long, 4>;  // lattice points, positively oriented

class Lattice {
 public:
  Lattice(const Field& field, const Vector3& low, const Vector3& high, double cube)
      : low_(low.array() - margin * cube), cube_(cube) {
    for (int k = 0; k < 3; ++k) {
      size_[static_cast<size_t>(k)] = static_cast<long>((high[k] - low[k]) / cube) + 2 * margin + 1;
    }
    values_.resize(static_cast<size_t>(2 * size_[0] * size_[1] * size_[2]));
    parallel_for(static_cast<std::int64_t>(values_.size()), 4096, 0,
                 [&](std::int64_t first, std::int64_t last) {
                   for (std::int64_t i = first; i < last; ++i) {
                     values_[static_cast<size_t>(i)] = field(position(i));
                   }
                 });
  }

  double value(long point) const { return values_[static_cast<size_t>(point)]; }

  Vector3 position(long point) const {
    const long cell = point / 2;
    const double shift = point % 2 == 0 ? 0 : 0.5;
    return low_ + cube_ * Vector3(static_cast<double>(cell % size_[0]) + shift,
                                  static_cast<double>(cell / size_[0] % size_[1]) + shift,
                                  static_cast<double>(cell / size_[0] / size_[1]) + shift);
  }

  /// Calls visit for every tetrahedron of the inner cubes.
  template <class Visit>
  void for_each_tetrahedron(Visit&& visit) const {
    for (long z = 1; z + 1 < size_[2]; ++z) {
      for (long y = 1; y + 1 < size_[1]; ++y) {
        for (long x = 1; x + 1 < size_[0]; ++x) {
          for (int axis = 0; axis < 3; ++axis) visit_face({x, y, z}, axis, visit);
        }
      }
    }
  }

 private:
  using Cell = std::array<long, 3>;

  long corner(const Cell& c) const { return 2 * (c[0] + size_[0] * (c[1] + size_[1] * c[2])); }
  long centre(const Cell& c) const { return corner(c) + 1; }

  /// The four tetrahedra about the face between a cube and the one before it along the axis.
  template <class Visit>
  void visit_face(const Cell& cell, int axis, Visit& visit) const {
    const auto a = static_cast<size_t>(axis), b = (a + 1) % 3, c = (a + 2) % 3;
    Cell before = cell;
    --before[a];
    std::array<Cell, 4> ring{cell, cell, cell, cell};  // counter-clockwise about the axis
    ++ring[1][b];
    ++ring[2][b], ++ring[2][c];
    ++ring[3][c];
    for (size_t k = 0; k < 4; ++k) {
      visit(Tetrahedron{centre(before), centre(cell), corner(ring[k]), corner(ring[(k + 1) % 4])});
    }
  }

  Vector3 low_;
  double cube_;
  std::array<long, 3> size_;
  std::vector<double> values_;
};

class Polygoniser {
 public:
  explicit Polygoniser(const Lattice& lattice) : lattice_(lattice) {}

  void add(const Tetrahedron& t) {
    std::array<bool, 4> inside;
    int count = 0;
    for (size_t k = 0; k < 4; ++k) {
      inside[k] = lattice_.value(t[k]) < 0;
      count += inside[k];
    }
    if (count == 1) add_corner(t, inside, true, false);
    if (count == 2) add_quadrilateral(t, inside);
    if (count == 3) add_corner(t, inside, false, true);
  }

  TriangleMesh mesh() const {
    TriangleMesh mesh;
    mesh.positions.resize(static_cast<Eigen::Index>(positions_.size()), 3);
    mesh.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (size_t v = 0; v < positions_.size(); ++v) {
      mesh.positions.row(static_cast<Eigen::Index>(v)) = positions_[v];
    }
    for (size_t f = 0; f < triangles_.size(); ++f) {
      mesh.triangles.row(static_cast<Eigen::Index>(f)) << triangles_[f][0], triangles_[f][1],
          triangles_[f][2];
    }
    return mesh;
  }

 private:
  /// One corner differs from the other three. In the even order (i, j, k, l) the triangle
  /// (ij, ik, il) looks away from corner i.
  void add_corner(const Tetrahedron& t, const std::array<bool, 4>& inside, bool side, bool turned) {
    constexpr std::array<std::array<size_t, 4>, 4> even{
        {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}}};
    for (const auto& [i, j, k, l] : even) {
      if (inside[i] != side) continue;
      const int a = crossing(t[i], t[j]), b = crossing(t[i], t[k]), c = crossing(t[i], t[l]);
      triangles_.push_back(turned ? std::array{a, c, b} : std::array{a, b, c});
    }
  }

  /// Corners i, j are inside: in an even order the quadrilateral (ik, il, jl, jk) looks outwards.
  void add_quadrilateral(const Tetrahedron& t, const std::array<bool, 4>& inside) {
    constexpr std::array<std::array<size_t, 4>, 6> even{
        {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
    for (const auto& [i, j, k, l] : even) {
      if (!inside[i] || !inside[j]) continue;
      const int a = crossing(t[i], t[k]), b = crossing(t[i], t[l]);
      const int c = crossing(t[j], t[l]), d = crossing(t[j], t[k]);
      triangles_.push_back({a, b, c});
      triangles_.push_back({a, c, d});
    }
  }

  /// The vertex on a lattice edge whose ends differ in sign.
  int crossing(long a, long b) {
    const auto edge = std::minmax(a, b);
    const auto [place, added] =
        vertices_.try_emplace({edge.first, edge.second}, static_cast<int>(positions_.size()));
    if (added) {
      const double at_a = lattice_.value(edge.first), at_b = lattice_.value(edge.second);
      const Vector3 from = lattice_.position(edge.first), to = lattice_.position(edge.second);
      positions_.push_back(from + at_a / (at_a - at_b) * (to - from));
    }
    return place->second;
  }

  const Lattice& lattice_;
  std::map<std::pair<long, long>, int> vertices_;
  std::vector<Vector3> positions_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace

Vector3 gradient(const Field& field, const Vector3& point, double step) {
  // Four directions of a tetrahedron instead of six of the axes.
  static const std::array<Vector3, 4> directions{Vector3(1, 1, 1), Vector3(1, -1, -1),
                                                 Vector3(-1, 1, -1), Vector3(-1, -1, 1)};
  Vector3 sum = Vector3::Zero();
  for (const Vector3& d : directions) sum += field(point + step * d) * d;
  return sum / (4 * step);
}

TriangleMesh level_set(const Field& field, const Vector3& low, const Vector3& high, double cube) {
  const Lattice lattice(field, low, high, cube);
  Polygoniser polygoniser(lattice);
  lattice.for_each_tetrahedron([&](const Tetrahedron& t) { polygoniser.add(t); });
  return polygoniser.mesh();
}

}  // namespace sphparam::samples
