#include "sphparam/sphere/distortion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "elementary.h"
#include "mesh/flat_face.h"
#include "sphere/required_rays.h"
#include "sphere/solid_angle.h"
#include "sphparam/parallel.h"

// One pass a triangle: source edges s0 s1 s2 (s_i faces corner i) and image chords e0 e1 e2. With
// doubled areas 2A = |s1 × s2| and dots_i = −s_j·s_k, corner i's angle is atan2(2A, dots_i) and its
// cotangent dots_i / 2A. From these follow, without any 2×2 frame,
//   ‖J‖² = σ1² + σ2² = Σ cot_i |e_i|² / 2A      and      det J = σ1 σ2 = A_chord / A.
// Two angles a triangle are computed, those at the ends of its longest side; the third, the
// largest, is what is missing to π: cheaper, and exact to rounding because it is never small.
// Arctangents and logarithms are made of some triangles at once. A source triangle without area has
// the share 0 of it, and with that counts in no figure; its ratios are those of the least area.

namespace sphparam {
namespace {

constexpr double sphere_area = 4 * std::numbers::pi;
constexpr double area_floor = 1e-9;  // of the mean source area
constexpr std::int64_t grain = 4096;
constexpr double infinity = std::numeric_limits<double>::infinity();

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
  double scale = unit_scale(mesh);

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

/// A row of a Distortion.
struct TriangleDistortion {
  std::array<double, 3> angle_ratio;
  double area_ratio, sigma_max, sigma_min, source_area;
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
TriangleDistortion distortion_of(const Pair& pair, Arctangents& arctangents, double to_sphere) {
  TriangleDistortion result;
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

/// Measures some triangles after the others of a mesh that has any.
class Measuring {
 public:
  Measuring(const TriangleMesh& mesh, const SphereMap& map, int threads)
      : mesh_(mesh), map_(map), source_{mesh} {
    const auto faces = static_cast<double>(mesh.face_count());
    const double mean = source_.total_doubled_area(0, threads) / faces;
    floor_ = std::max(area_floor * mean, std::numeric_limits<double>::min());
    // A mesh of no area at all still gets finite ratios: every triangle the same.
    const double total = mean > 0 ? source_.total_doubled_area(floor_, threads) : floor_ * faces;
    to_sphere_ = sphere_area / (total / 2);
  }

  static constexpr size_t most = 64;  // triangles at once

  /// Triangles first, first + 1, …. Requires: at most `most`.
  void measure(Eigen::Index first, std::span<TriangleDistortion> rows) const {
    std::array<Pair, most> pairs;
    Arctangents<most * Pair::angles> arctangents;
    for (size_t i = 0; i < rows.size(); ++i) {
      const Eigen::Index f = first + static_cast<Eigen::Index>(i);
      pairs[i].source = source_.triangle(f);
      pairs[i].has_area = !pairs[i].source.is_flat();
      pairs[i].source.doubled_area = std::max(pairs[i].source.doubled_area, floor_);
      const auto ray = [&](int k) { return map_.point(mesh_.triangles(f, k)); };
      pairs[i].ask(arctangents, ray(0), ray(1), ray(2));
    }
    arctangents.make();
    for (size_t i = 0; i < rows.size(); ++i)
      rows[i] = distortion_of(pairs[i], arctangents, to_sphere_);
  }

 private:
  const TriangleMesh& mesh_;
  const SphereMap& map_;
  Source source_;
  double floor_ = 0, to_sphere_ = 1;
};

/// Sums and extremes over some triangles; they merge in a fixed order.
struct Tally {
  double ln_area = 0, ln_angle = 0, within_two = 0;
  long flat_images = 0, flat_faces = 0;
  double log2_area = 0, dirichlet = 0, conformal = 0, stretch = 0, area = 0;
  double area_min = infinity, area_max = 0, angle_max = 1, conformal_max = 1, sigma_min = infinity;

  /// Requires: at most Measuring::most.
  void add(std::span<const TriangleDistortion> rows) {
    constexpr size_t ratios = 4;  // of a triangle
    std::array<double, Measuring::most * ratios> values, logs;
    size_t count = 0;
    for (const TriangleDistortion& d : rows) {
      values[count++] = d.area_ratio;
      for (const double ratio : d.angle_ratio) values[count++] = ratio;
    }
    elementary::log(std::span(values).first(count), std::span(logs).first(count));
    for (size_t i = 0; i < rows.size(); ++i)
      add(rows[i], std::span(logs).subspan(ratios * i).first<ratios>());
  }

  void add(const TriangleDistortion& d, std::span<const double, 4> logs) {
    const double ratio = d.area_ratio, share = d.source_area;
    if (share == 0) {
      ++flat_faces;
      return;
    }
    const double ln_ratio = std::abs(logs[0]);
    ln_area += ln_ratio;
    within_two += ratio >= 0.5 && ratio <= 2 ? 1 : 0;
    area_min = std::min(area_min, ratio);
    area_max = std::max(area_max, ratio);
    bool flat = false;
    for (const double angle : d.angle_ratio) {
      flat |= angle == 0;
      angle_max = std::max({angle_max, angle, 1 / angle});
    }
    flat_images += flat;
    for (int k = 1; k <= 3 && !flat; ++k) ln_angle += std::abs(logs[k]);
    const double s1 = d.sigma_max, s2 = d.sigma_min;
    const double squeeze = 1 / (s1 * s1) + 1 / (s2 * s2);  // σ1⁻² + σ2⁻²
    const double quasi_conformal = s2 > 0 ? s1 / s2 : infinity;
    area += share;
    log2_area += share * ln_ratio / std::numbers::ln2;
    dirichlet += share * (s1 * s1 + s2 * s2 + squeeze);
    stretch += share * squeeze / 2;
    conformal += share * quasi_conformal;
    conformal_max = std::max(conformal_max, quasi_conformal);
    sigma_min = std::min(sigma_min, s2);
  }

  void merge(const Tally& other) {
    ln_area += other.ln_area, ln_angle += other.ln_angle, within_two += other.within_two;
    flat_images += other.flat_images, flat_faces += other.flat_faces;
    log2_area += other.log2_area, dirichlet += other.dirichlet, conformal += other.conformal;
    stretch += other.stretch, area += other.area;
    area_min = std::min(area_min, other.area_min), area_max = std::max(area_max, other.area_max);
    angle_max = std::max(angle_max, other.angle_max);
    conformal_max = std::max(conformal_max, other.conformal_max);
    sigma_min = std::min(sigma_min, other.sigma_min);
  }
};

/// Calls of(first, rows) for all triangles from first to last, some at a time.
template <class Of>
void for_some(std::int64_t first, std::int64_t last, const Of& of) {
  std::array<TriangleDistortion, Measuring::most> rows;
  constexpr std::int64_t most = Measuring::most;
  for (; first < last; first += most)
    of(first, std::span(rows).first(static_cast<size_t>(std::min(most, last - first))));
}

/// Of all triangles: `fill(first, rows)` makes their rows.
template <class Fill>
Tally tally(Eigen::Index faces, int threads, const Fill& fill) {
  std::vector<Tally> partial(static_cast<size_t>((faces + grain - 1) / grain));
  parallel_for(faces, grain, threads, [&](std::int64_t first, std::int64_t last) {
    Tally local;
    for_some(first, last, [&](std::int64_t from, std::span<TriangleDistortion> rows) {
      fill(from, rows);
      local.add(rows);
    });
    partial[static_cast<size_t>(first / grain)] = local;
  });
  Tally total;
  for (const Tally& part : partial) total.merge(part);
  return total;
}

/// The values at 1, 50 and 99 % of the sorted list, nearest rank.
std::array<double, 3> percentiles(VectorX v) {
  const auto begin = v.begin();
  const auto select = [&](double share, auto first, auto last) {
    const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(v.size() - 1) + 0.5);
    std::nth_element(first, begin + rank, last);
    return begin + rank;
  };
  const auto middle = select(0.5, begin, v.end());
  const double median = *middle;  // read now: the next call may move it
  const double low = *select(0.01, begin, middle + 1);
  const double high = *select(0.99, middle, v.end());
  return {low, median, high};
}

/// What a mesh without any area has: there is nothing that any map could keep.
DistortionSummary nothing_measured(long flat_faces) {
  return {
      .mean_abs_ln_area = infinity,
      .mean_abs_ln_angle = infinity,
      .area_ratio_p01 = infinity,
      .area_ratio_p50 = infinity,
      .area_ratio_p99 = infinity,
      .area_ratio_min = infinity,
      .area_ratio_max = infinity,
      .angle_ratio_max = infinity,
      .weighted_abs_log2_area = infinity,
      .symmetric_dirichlet = infinity,
      .quasi_conformal_mean = infinity,
      .quasi_conformal_max = infinity,
      .stretch_l2 = infinity,
      .stretch_linf = infinity,
      .flat_faces = flat_faces,
  };
}

/// `area_ratio`: of the faces that have an area.
DistortionSummary summary_of(const Tally& total, VectorX area_ratio) {
  if (area_ratio.size() == 0) return nothing_measured(total.flat_faces);
  const auto faces = static_cast<double>(area_ratio.size());
  const double with_angles = faces - static_cast<double>(total.flat_images);
  const auto [p01, p50, p99] = percentiles(std::move(area_ratio));
  return {
      .mean_abs_ln_area = total.ln_area / faces,
      .mean_abs_ln_angle = with_angles > 0 ? total.ln_angle / (3 * with_angles) : infinity,
      .area_within_two = total.within_two / faces,
      .area_ratio_p01 = p01,
      .area_ratio_p50 = p50,
      .area_ratio_p99 = p99,
      .area_ratio_min = total.area_min,
      .area_ratio_max = total.area_max,
      .angle_ratio_max = total.angle_max,
      .weighted_abs_log2_area = total.log2_area / total.area,
      .symmetric_dirichlet = total.dirichlet / total.area,
      .quasi_conformal_mean = total.conformal / total.area,
      .quasi_conformal_max = total.conformal_max,
      .stretch_l2 = std::sqrt(total.stretch / total.area),
      .stretch_linf = 1 / total.sigma_min,
      .flat_images = total.flat_images,
      .flat_faces = total.flat_faces,
  };
}

/// The ratios of the faces that have an area.
VectorX with_area(const VectorX& area_ratio, const VectorX& source_area) {
  VectorX kept(area_ratio.size());
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < area_ratio.size(); ++f)
    if (source_area[f] != 0) kept[count++] = area_ratio[f];
  kept.conservativeResize(count);
  return kept;
}

}  // namespace

Distortion measure_distortion(const TriangleMesh& mesh, const SphereMap& map, int threads) {
  require_rays("measure_distortion", map, mesh.vertex_count());
  const Eigen::Index faces = mesh.face_count();
  Distortion result{VectorX(faces), {}, VectorX(faces), VectorX(faces), VectorX(faces)};
  result.angle_ratio.resize(faces, 3);
  if (faces == 0) return result;
  const Measuring measuring(mesh, map, threads);
  parallel_for(faces, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for_some(first, last, [&](Eigen::Index f, std::span<TriangleDistortion> rows) {
      measuring.measure(f, rows);
      for (const TriangleDistortion& d : rows) {
        for (int k = 0; k < 3; ++k) result.angle_ratio(f, k) = d.angle_ratio[k];
        result.area_ratio[f] = d.area_ratio;
        result.sigma_max[f] = d.sigma_max;
        result.sigma_min[f] = d.sigma_min;
        result.source_area[f++] = d.source_area;
      }
    });
  });
  return result;
}

DistortionSummary summarise(const Distortion& d, int threads) {
  if (d.area_ratio.size() == 0) return {};
  const auto copy = [&](Eigen::Index f, std::span<TriangleDistortion> rows) {
    for (TriangleDistortion& row : rows) {
      row = {{d.angle_ratio(f, 0), d.angle_ratio(f, 1), d.angle_ratio(f, 2)},
             d.area_ratio[f],
             d.sigma_max[f],
             d.sigma_min[f],
             d.source_area[f]};
      ++f;
    }
  };
  return summary_of(tally(d.area_ratio.size(), threads, copy),
                    with_area(d.area_ratio, d.source_area));
}

DistortionSummary summarise_distortion(const TriangleMesh& mesh, const SphereMap& map,
                                       int threads) {
  require_rays("summarise_distortion", map, mesh.vertex_count());
  const Eigen::Index faces = mesh.face_count();
  if (faces == 0) return {};
  const Measuring measuring(mesh, map, threads);
  VectorX area_ratio(faces);
  constexpr double none = -1;  // of a face without area
  const Tally total =
      tally(faces, threads, [&](Eigen::Index f, std::span<TriangleDistortion> rows) {
        measuring.measure(f, rows);
        for (const TriangleDistortion& d : rows)
          area_ratio[f++] = d.source_area == 0 ? none : d.area_ratio;
      });
  area_ratio.conservativeResize(std::remove(area_ratio.begin(), area_ratio.end(), none) -
                                area_ratio.begin());
  return summary_of(total, std::move(area_ratio));
}

}  // namespace sphparam
