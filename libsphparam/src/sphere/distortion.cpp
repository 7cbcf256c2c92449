#include "sphparam/sphere/distortion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "elementary.h"
#include "sphere/required_rays.h"
#include "sphere/triangle_distortion.h"
#include "sphparam/parallel.h"

// All triangles are measured in one pass (triangle_distortion.h), some at a time; their logarithms
// are made of as many at once. Chunks are tallied apart and merged in order, so that sums have the
// same bits for any number of threads. Triangles without area count in no figure.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sums and extremes over some triangles; they merge in a fixed order.
struct Tally {
  double ln_area = 0, ln_angle = 0, within_two = 0;
  long flat_images = 0, flat_faces = 0;
  double log2_area = 0, dirichlet = 0, conformal = 0, stretch = 0, area = 0;
  double area_min = infinity, area_max = 0, angle_max = 1, conformal_max = 1, sigma_min = infinity;

  /// Requires: at most TriangleMeter::most.
  void add(std::span<const DistortionRow> rows) {
    constexpr size_t ratios = 4;  // of a triangle
    std::array<double, TriangleMeter::most * ratios> values, logs;
    size_t count = 0;
    for (const DistortionRow& d : rows) {
      values[count++] = d.area_ratio;
      for (const double ratio : d.angle_ratio) values[count++] = ratio;
    }
    elementary::log(std::span(values).first(count), std::span(logs).first(count));
    for (size_t i = 0; i < rows.size(); ++i)
      add(rows[i], std::span(logs).subspan(ratios * i).first<ratios>());
  }

  void add(const DistortionRow& d, std::span<const double, 4> logs) {
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
  std::array<DistortionRow, TriangleMeter::most> rows;
  constexpr std::int64_t most = TriangleMeter::most;
  for (; first < last; first += most)
    of(first, std::span(rows).first(static_cast<size_t>(std::min(most, last - first))));
}

/// Of all triangles: `fill(first, rows)` makes their rows.
template <class Fill>
Tally tally(Eigen::Index faces, int threads, const Fill& fill) {
  std::vector<Tally> partial(static_cast<size_t>((faces + grain - 1) / grain));
  parallel_for(faces, grain, threads, [&](std::int64_t first, std::int64_t last) {
    Tally local;
    for_some(first, last, [&](std::int64_t from, std::span<DistortionRow> rows) {
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
  const TriangleMeter meter(mesh, map, threads);
  parallel_for(faces, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for_some(first, last, [&](Eigen::Index f, std::span<DistortionRow> rows) {
      meter.measure(f, rows);
      for (const DistortionRow& d : rows) {
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
  const auto copy = [&](Eigen::Index f, std::span<DistortionRow> rows) {
    for (DistortionRow& row : rows) {
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
  const TriangleMeter meter(mesh, map, threads);
  VectorX area_ratio(faces);
  constexpr double none = -1;  // of a face without area
  const Tally total = tally(faces, threads, [&](Eigen::Index f, std::span<DistortionRow> rows) {
    meter.measure(f, rows);
    for (const DistortionRow& d : rows) area_ratio[f++] = d.source_area == 0 ? none : d.area_ratio;
  });
  area_ratio.conservativeResize(std::remove(area_ratio.begin(), area_ratio.end(), none) -
                                area_ratio.begin());
  return summary_of(total, std::move(area_ratio));
}

}  // namespace sphparam
