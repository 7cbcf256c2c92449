#include "geodesic_sphere.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

// Pair i lies in square (i mod 5, i / 5) of the atlas with P at its lower left, Q lower right, R
// upper left, S upper right: (a, b) in the square stands for P + a(Q − P) + b(R − P) below the
// diagonal QR and for S + (1 − a)(R − S) + (1 − b)(Q − S) above it.

namespace sphparam::samples {
namespace {

constexpr int column_count = 5, row_count = 2;

Icosahedron make_icosahedron() {
  Icosahedron result;
  const double z = 1 / std::sqrt(5.0), r = 2 * z;
  result.vertices[0] = Vector3::UnitZ();
  result.vertices[11] = -Vector3::UnitZ();
  for (int k = 0; k < 5; ++k) {
    const double upper = 2 * std::numbers::pi * k / 5, lower = upper + std::numbers::pi / 5;
    result.vertices[static_cast<size_t>(1 + k)] = {r * std::cos(upper), r * std::sin(upper), z};
    result.vertices[static_cast<size_t>(6 + k)] = {r * std::cos(lower), r * std::sin(lower), -z};
  }
  for (int k = 0; k < 5; ++k) {
    const int next = (k + 1) % 5;
    result.pairs[static_cast<size_t>(k)] = {0, 1 + k, 1 + next, 6 + k};
    result.pairs[static_cast<size_t>(5 + k)] = {1 + next, 6 + k, 6 + next, 11};
  }
  return result;
}

/// A point of a face by its corners and integer barycentric coordinates, named so that neighbouring
/// faces name their common points alike.
using PointName = std::array<std::pair<int, int>, 3>;

PointName name_of(std::array<std::pair<int, int>, 3> weighted_corners) {
  for (auto& [corner, weight] : weighted_corners) {
    if (weight == 0) corner = -1;
  }
  std::sort(weighted_corners.begin(), weighted_corners.end());
  return weighted_corners;
}

class Builder {
 public:
  Builder(int frequency, double margin) : f_(frequency), margin_(margin) {
    result_.mesh.positions.resize(10L * f_ * f_ + 2, 3);
    result_.mesh.triangles.resize(20L * f_ * f_, 3);
    result_.texcoords.resize(60L * f_ * f_, 2);
  }

  GeodesicSphere build() {
    for (int pair = 0; pair < 10; ++pair) {
      add_face(pair, false);
      add_face(pair, true);
    }
    return std::move(result_);
  }

 private:
  void add_face(int pair, bool upper) {
    for (int i = 0; i < f_; ++i) {
      for (int j = 0; i + j < f_; ++j) {
        add_triangle(pair, upper, {{{i, j}, {i + 1, j}, {i, j + 1}}});
        if (i + j + 1 < f_) add_triangle(pair, upper, {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
      }
    }
  }

  /// Corners in steps along the face's two sides from its first corner.
  void add_triangle(int pair, bool upper, const std::array<std::array<int, 2>, 3>& corners) {
    for (int k = 0; k < 3; ++k) {
      const auto [i, j] = corners[static_cast<size_t>(k)];
      result_.mesh.triangles(face_, k) = vertex(pair, upper, i, j);
      const double a = static_cast<double>(i) / f_, b = static_cast<double>(j) / f_;
      const double x = upper ? 1 - a : a, y = upper ? 1 - b : b;
      result_.texcoords.row(3 * face_ + k)
          << (pair % 5 + margin_ + x * (1 - 2 * margin_)) / column_count,
          (pair / 5 + margin_ + y * (1 - 2 * margin_)) / row_count;
    }
    ++face_;
  }

  int vertex(int pair, bool upper, int i, int j) {
    const auto& [p, q, r, s] = icosahedron().pairs[static_cast<size_t>(pair)];
    const std::array<int, 3> face = upper ? std::array{s, r, q} : std::array{p, q, r};
    const PointName name = name_of({{{face[0], f_ - i - j}, {face[1], i}, {face[2], j}}});
    const auto [place, added] = vertices_.try_emplace(name, static_cast<int>(vertices_.size()));
    if (added) {
      Vector3 point = Vector3::Zero();
      for (const auto& [corner, weight] : name) {
        if (weight > 0) point += weight * icosahedron().vertices[static_cast<size_t>(corner)];
      }
      result_.mesh.positions.row(place->second) = point.normalized();
    }
    return place->second;
  }

  int f_;
  double margin_;
  Eigen::Index face_ = 0;
  std::map<PointName, int> vertices_;
  GeodesicSphere result_;
};

}  // namespace

const Icosahedron& icosahedron() {
  static const Icosahedron instance = make_icosahedron();
  return instance;
}

GeodesicSphere geodesic_sphere(int frequency, double margin) {
  return Builder(frequency, margin).build();
}

Vector3 atlas_direction(double u, double v, double margin) {
  const int column = std::clamp(static_cast<int>(u * column_count), 0, column_count - 1);
  const int row = std::clamp(static_cast<int>(v * row_count), 0, row_count - 1);
  const double a = (u * column_count - column - margin) / (1 - 2 * margin);
  const double b = (v * row_count - row - margin) / (1 - 2 * margin);
  const auto& pair = icosahedron().pairs[static_cast<size_t>(column_count * row + column)];
  const auto corner = [&](size_t k) {
    return icosahedron().vertices[static_cast<size_t>(pair[k])];
  };
  const Vector3 p = corner(0), q = corner(1), r = corner(2), s = corner(3);
  const Vector3 point = a + b <= 1 ? Vector3(p + a * (q - p) + b * (r - p))
                                   : Vector3(s + (1 - a) * (r - s) + (1 - b) * (q - s));
  return point.normalized();
}

}  // namespace sphparam::samples
