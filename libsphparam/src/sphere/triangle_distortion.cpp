#include "sphere/triangle_distortion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "elementary.h"
#include "mesh/flat_face.h"
#include "sphere/solid_angle.h"
#include "sphparam/parallel.h"

// One pass a triangle: source edges s0 s1 s2 (s_i faces corner i) and image chords e0 e1 e2. With
// doubled areas 2A = |s1 × s2| and dots_i = −s_j·s_k, corner i's angle is atan2(2A, dots_i) and its
// cotangent dots_i / 2A. From these follow, without any 2×2 frame,
//   ‖J‖² = σ1² + σ2² = Σ cot_i |e_i|² / 2A      and      det J = σ1 σ2 = A_chord / A.
// Two angles a triangle are computed, those at the ends of its longest side; the third, the
// largest, is what is missing to π: cheaper, and exact to rounding because it is never small.
// Arctangents are made of some triangles at once. A source triangle without area has the share 0 of
// it; its ratios are those of the least area.

namespace sphparam {
namespace {

constexpr double sphere_area = 4 * std::numbers::pi;
constexpr double area_floor = 1e-9;  // of the mean source area

/// What the formulas need of a plane triangle.
struct PlaneTriangle {
  std::array<double, 3> squared;  // |s_i|², side i faces corner i
  std::array<double, 3> dots;     // of the two sides that meet at corner i
  double doubled_area;

  bool is_flat() const {
    return doubled_area / 2 <= flat_area * *std::max_element(squared.begin(), squared.end());
  }
};

PlaneTriangle plane_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, bc = c - b, ca = a - c;
  return {{bc.squaredNorm(), ca.squaredNorm(), ab.squaredNorm()},
          {-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)},
          ab.cross(-ca).norm()};
}

/// The corners at the ends of the longest side, and the one that faces it.
struct Corners {
  int first, second, facing;
};

Corners about_longest_side(const PlaneTriangle& t) {
  const int longest =
      static_cast<int>(std::max_element(t.squared.begin(), t.squared.end()) - t.squared.begin());
  return {(longest + 1) % 3, (longest + 2) % 3, longest};
}

std::array<double, 3> angles_from(const Corners& at, double first, double second) {
  std::array<double, 3> angle;
  angle[at.first] = first;
  angle[at.second] = second;
  // At least π/3, as the largest must be: where the area is a floor the sum of the three is not π.
  angle[at.facing] = std::max(std::numbers::pi / 3, std::numbers::pi - first - second);
  return angle;
}

/// Arctangents that are asked for one by one and made all at once.
template <size_t most>
class Arctangents {
 public:
  void ask(double y, double x) {
    y_[count_] = y;
    x_[count_++] = x;
  }
  void make() {
    elementary::atan2(std::span(y_).first(count_), std::span(x_).first(count_),
                      std::span(angles_).first(count_));
    count_ = 0;
  }
  /// In the order in which they were asked for.
  double next() { return angles_[count_++]; }

 private:
  std::array<double, most> y_, x_, angles_;
  size_t count_ = 0;
};

/// A power of two that brings the mesh to about unit size, so that no square overflows.
double unit_scale(const TriangleMesh& mesh) {
  const double extent = mesh.positions.cwiseAbs().maxCoeff();
  constexpr int greatest = 1023;  // 2¹⁰²⁴ is infinite, and subnormal coordinates ask for more
  return extent > 0 ? std::ldexp(1.0, std::min(greatest, -std::ilogb(extent))) : 1;
}

/// The mesh, made about unit size.
struct Source {
  const TriangleMesh& mesh;
  double scale;

  PlaneTriangle triangle(Eigen::Index f) const {
    const auto corner = [&](int k) -> Vector3 {
      return scale * mesh.position(mesh.triangles(f, k));
    };
    return plane_triangle(corner(0), corner(1), corner(2));
  }

  double total_doubled_area(double floor, int threads) const {
    return parallel_sum(mesh.face_count(), threads, [&](std::int64_t first, std::int64_t last) {
      double sum = 0;
      for (Eigen::Index f = first; f < last; ++f) {
        const PlaneTriangle one = triangle(f);
        if (!one.is_flat()) sum += std::max(floor, one.doubled_area);
      }
      return sum;
    });
  }
};

/// A triangle and its image while its angles are being made.
struct Pair {
  PlaneTriangle source, chord;
  bool has_area = true;  // of the source; its floor stands there where not
  Corners source_corners, chord_corners;
  static constexpr size_t angles = 5;  // two of each, and half the solid angle

  template <class Arctangents>
  void ask(Arctangents& arctangents, const Vector3& a, const Vector3& b, const Vector3& c) {
    chord = plane_triangle(a, b, c);
    source_corners = about_longest_side(source), chord_corners = about_longest_side(chord);
    for (const auto& [triangle, at] :
         {std::pair(&source, source_corners), std::pair(&chord, chord_corners)}) {
      arctangents.ask(triangle->doubled_area, triangle->dots[at.first]);
      arctangents.ask(triangle->doubled_area, triangle->dots[at.second]);
    }
    const HalfSolidAngle half = half_solid_angle_of(a, b, c);
    arctangents.ask(half.sine, half.cosine);
  }
};

/// `to_sphere` scales source areas so that they sum to 4π.
template <class Arctangents>
DistortionRow distortion_of(const Pair& pair, Arctangents& arctangents, double to_sphere) {
  DistortionRow result;
  const PlaneTriangle &source = pair.source, &chord = pair.chord;
  const auto angles_at = [&](const Corners& at) {
    const double first = arctangents.next(), second = arctangents.next();
    return angles_from(at, first, second);
  };
  const std::array<double, 3> before = angles_at(pair.source_corners),
                              after = angles_at(pair.chord_corners);
  for (int k = 0; k < 3; ++k) result.angle_ratio[k] = after[k] / before[k];

  const double area = source.doubled_area * to_sphere / 2;
  result.source_area = pair.has_area ? area / sphere_area : 0;
  result.area_ratio = std::abs(2 * arctangents.next()) / area;

  // σ1 σ2 = A_chord / A
  const double det = chord.doubled_area / (2 * area);
  // σ1² + σ2² = Σ cot_i |e_i|² / 2A; never less than 2 σ1 σ2 but for rounding and the area floor
  double squares = 0;
  for (int k = 0; k < 3; ++k) squares += source.dots[k] * chord.squared[k];
  squares = std::max(squares / source.doubled_area / (2 * area), 2 * det);
  // σ1,2 = (√(‖J‖² + 2 det) ± √(‖J‖² − 2 det)) / 2, the smaller one without cancellation
  const double sigma_max = (std::sqrt(squares + 2 * det) + std::sqrt(squares - 2 * det)) / 2;
  result.sigma_max = sigma_max;
  result.sigma_min = sigma_max > 0 ? det / sigma_max : 0;
  return result;
}

}  // namespace

TriangleMeter::TriangleMeter(const TriangleMesh& mesh, const SphereMap& map, int threads)
    : mesh_(mesh), map_(map), scale_(unit_scale(mesh)) {
  const Source source{mesh_, scale_};
  const auto faces = static_cast<double>(mesh.face_count());
  const double mean = source.total_doubled_area(0, threads) / faces;
  least_doubled_area_ = std::max(area_floor * mean, std::numeric_limits<double>::min());
  // A mesh of no area at all still gets finite ratios: every triangle the same.
  const double total = mean > 0 ? source.total_doubled_area(least_doubled_area_, threads)
                                : least_doubled_area_ * faces;
  to_sphere_ = sphere_area / (total / 2);
}

void TriangleMeter::measure(Eigen::Index first, std::span<DistortionRow> rows) const {
  const Source source{mesh_, scale_};
  std::array<Pair, most> pairs;
  Arctangents<most * Pair::angles> arctangents;
  for (size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Index f = first + static_cast<Eigen::Index>(i);
    pairs[i].source = source.triangle(f);
    pairs[i].has_area = !pairs[i].source.is_flat();
    pairs[i].source.doubled_area = std::max(pairs[i].source.doubled_area, least_doubled_area_);
    const auto ray = [&](int k) { return map_.point(mesh_.triangles(f, k)); };
    pairs[i].ask(arctangents, ray(0), ray(1), ray(2));
  }
  arctangents.make();
  for (size_t i = 0; i < rows.size(); ++i)
    rows[i] = distortion_of(pairs[i], arctangents, to_sphere_);
}

}  // namespace sphparam
