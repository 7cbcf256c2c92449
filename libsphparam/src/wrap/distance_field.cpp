// Blocks of 16³ points, halved until the distance of their middle decides for all of them, which
// changes by no more than one goes; points one by one where none does. Between the
// corners c of a block, whose weights w are linear along each axis, the distance f is taken for
// Σ w (f(c) + ½ ∇f(c)·(p − c)), which is exact wherever f is quadratic: linear interpolation is off
// by as much as planes along ∇f are, the other way. ∇f points away from the nearest point.

#include "wrap/distance_field.h"

#include <algorithm>
#include <cmath>

#include "rays/interpolation.h"
#include "rays/ray_scene.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr int block = 16;     // points a side
constexpr int undivided = 2;  // whose points are asked for one by one
constexpr double smooth = 3;  // how far from the soup, in half diagonals, distances are smooth
const double root3 = std::sqrt(3.0);

struct Range {
  std::array<int, 3> first, last;  // both of it
  int side() const {
    return std::max({last[0] - first[0], last[1] - first[1], last[2] - first[2]}) + 1;
  }
};

class Filler {
 public:
  Filler(const TriangleMesh& soup, const RayScene& rays, const Lattice& lattice, double distance,
         std::vector<float>& field)
      : soup_(soup),
        rays_(rays),
        lattice_(lattice),
        distance_(distance / lattice.voxel),
        field_(field) {}

  void fill(const Range& range) {
    const Vector3 middle = 0.5 * (at(range.first) + at(range.last));
    const double there = farther_by(middle), reach = (at(range.last) - middle).norm();
    if (there + reach < -root3) return set_all(range, there);
    if (there - reach > root3 && there + distance_ > smooth * reach)
      return interpolate(range, there - reach);
    if (range.side() <= undivided) return ask_each(range);
    halve(range, 0);
  }

 private:
  /// Its distance, and which way that grows.
  struct Corner {
    Vector3 at, away;
    double value;
    double half_way_to(const Vector3& p) const { return value + away.dot(p - at) / 2; }
  };

  Corner corner_at(const Vector3& p) {
    const double value = farther_by(p);
    const Vector3 place = lattice_.position(p.x(), p.y(), p.z());
    return {p, (place - nearest_).stableNormalized(), value};
  }

  static Vector3 at(const std::array<int, 3>& p) { return {1.0 * p[0], 1.0 * p[1], 1.0 * p[2]}; }

  double farther_by(const Vector3& p) {
    const NearestPoint found = rays_.nearest(lattice_.position(p.x(), p.y(), p.z()), guess_);
    guess_ = found.on.face;
    nearest_ = sphparam::interpolate(soup_.positions, soup_.triangles, found.on);
    return std::sqrt(found.squared_distance) / lattice_.voxel - distance_;
  }

  template <class Value>
  void for_each(const Range& range, const Value& value) {
    for (int z = range.first[2]; z <= range.last[2]; ++z) {
      for (int y = range.first[1]; y <= range.last[1]; ++y) {
        for (int x = range.first[0]; x <= range.last[0]; ++x) {
          field_[static_cast<size_t>(lattice_.index(x, y, z))] =
              static_cast<float>(value(Vector3(x, y, z)));
        }
      }
    }
  }

  void set_all(const Range& range, double value) {
    for_each(range, [&](const Vector3&) { return value; });
  }
  void ask_each(const Range& range) {
    for_each(range, [&](const Vector3& p) { return farther_by(p); });
  }

  /// Between the corners.
  void interpolate(const Range& range, double at_least) {
    const Vector3 first = at(range.first), size = (at(range.last) - first).cwiseMax(1);
    std::array<Corner, 8> corners{};
    for (int c = 0; c < 8; ++c) {
      const Vector3 unit(c & 1, c >> 1 & 1, c >> 2 & 1);
      corners[c] = corner_at(first + unit.cwiseProduct(at(range.last) - first));
    }
    for_each(range, [&](const Vector3& p) {
      const Vector3 t = (p - first).cwiseQuotient(size);
      double sum = 0;
      for (int c = 0; c < 8; ++c) {
        sum += corners[c].half_way_to(p) * (c & 1 ? t.x() : 1 - t.x()) *
               (c & 2 ? t.y() : 1 - t.y()) * (c & 4 ? t.z() : 1 - t.z());
      }
      return std::max(sum, at_least);
    });
  }

  /// Along this axis and those after it.
  void halve(const Range& range, int axis) {
    if (axis == 3) return fill(range);
    const int middle = (range.first[axis] + range.last[axis]) / 2;
    Range half = range;
    half.last[axis] = middle;
    halve(half, axis + 1);
    if (middle == range.last[axis]) return;
    half.last[axis] = range.last[axis];
    half.first[axis] = middle + 1;
    halve(half, axis + 1);
  }

  const TriangleMesh& soup_;
  const RayScene& rays_;
  const Lattice& lattice_;
  const double distance_;  // in voxels
  std::vector<float>& field_;
  Face guess_ = -1;
  Vector3 nearest_ = Vector3::Zero();  // of the soup, to where it was asked for last
};

}  // namespace

std::vector<float> distance_field(const TriangleMesh& soup, const Lattice& lattice, double distance,
                                  int threads, const Progress& progress) {
  const RayScene rays(soup);
  std::vector<float> field(static_cast<size_t>(lattice.size()));
  std::array<int, 3> blocks{};
  for (int axis = 0; axis < 3; ++axis) blocks[axis] = (lattice.points[axis] + block - 1) / block;
  const std::int64_t of_layer = std::int64_t{blocks[0]} * blocks[1];
  for (int layer = 0; layer < blocks[2]; ++layer) {
    report(progress, "distances", static_cast<double>(layer) / blocks[2]);
    parallel_for(of_layer, 1, threads, [&](std::int64_t from, std::int64_t to) {
      for (std::int64_t b = from; b < to; ++b) {
        Range range{{static_cast<int>(b % blocks[0]), static_cast<int>(b / blocks[0]), layer}, {}};
        for (int axis = 0; axis < 3; ++axis) {
          range.first[axis] *= block;
          range.last[axis] = std::min(range.first[axis] + block, lattice.points[axis]) - 1;
        }
        Filler(soup, rays, lattice, distance, field).fill(range);
      }
    });
  }
  return field;
}

}  // namespace sphparam
