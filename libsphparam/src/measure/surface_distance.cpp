// Every used vertex, then samples on faces and edges, each asked for its nearest point on the other
// surface; last, what lies between them and could be farther. Samples ascend over the faces, so
// that the face found last is a good guess for the next.

#include "sphparam/measure/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "measure/border.h"
#include "measure/enclosure.h"
#include "measure/farthest_point.h"
#include "measure/measurable_side.h"
#include "measure/surface_samples.h"
#include "number_text.h"
#include "rays/ray_scene.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr std::int64_t chunk = 1024;         // that one thread measures at once
constexpr std::int64_t block = 64 * chunk;   // between two calls of the progress
constexpr std::int64_t most_kept = 1 << 22;  // samples for percentiles: 64 MB
constexpr std::int64_t most_cuts =
    1 << 20;  // for the bound, as many as samples; up to 150 bytes each

// a + u (b − a) + v (c − a) is off by at most some twenty roundings of the largest coordinate.
constexpr double sample_rounding = 0x1p-48;

// Beyond, coordinates are scaled by a power of two, so that their squares are numbers,
// and so that those of areas, fourth powers of lengths, are.
constexpr double largest_unscaled = 1e60, smallest_unscaled = 1e-60;

struct Tally {
  double max = -1, min = std::numeric_limits<double>::infinity(), sum = 0, squares = 0;
  double most_inside = std::numeric_limits<double>::infinity(), most_outside = -most_inside;
  double signed_sum = 0;
  std::int64_t count = 0, near = 0;  // `near`: within what is asked for
  std::int64_t left_out = 0;         // and in nothing else here
  Vector3 farthest = Vector3::Zero();

  /// `deviation`: the distance, less than 0 inside.
  void add(double distance, double deviation, const Vector3& point) {
    if (distance > max) {
      max = distance;
      farthest = point;
    }
    min = std::min(min, distance);
    sum += distance;
    squares += distance * distance;
    add_deviation(deviation);
    signed_sum += deviation;
    ++count;
  }
  /// The other's points come after these: of equal maxima, the first stays.
  void add(const Tally& other) {
    if (other.max > max) {
      max = other.max;
      farthest = other.farthest;
    }
    min = std::min(min, other.min);
    sum += other.sum;
    squares += other.squares;
    most_inside = std::min(most_inside, other.most_inside);
    most_outside = std::max(most_outside, other.most_outside);
    signed_sum += other.signed_sum;
    count += other.count;
    near += other.near;
    left_out += other.left_out;
  }
  void add_deviation(double deviation) {
    most_inside = std::min(most_inside, deviation);
    most_outside = std::max(most_outside, deviation);
  }
};

/// Every stride-th sample, for percentiles.
struct Kept {
  std::int64_t stride = 1;
  std::vector<double> distances, deviations;

  /// Takes up every stride-th of so many more; returns where the first of these is.
  std::int64_t make_room(std::int64_t count) {
    const std::int64_t first = std::ssize(distances);
    distances.resize(static_cast<size_t>(first + (count + stride - 1) / stride));
    deviations.resize(distances.size());
    return first;
  }
  void put(std::int64_t first, std::int64_t i, double distance, double deviation) {
    if (i % stride != 0) return;
    const auto at = static_cast<size_t>(first + i / stride);
    distances[at] = distance;
    deviations[at] = deviation;
  }
  void leave_out(std::int64_t first, std::int64_t i) { put(first, i, NAN, NAN); }
  void forget_left_out() {
    for (std::vector<double>* values : {&distances, &deviations})
      std::erase_if(*values, [](double value) { return std::isnan(value); });
  }
};

/// By nearest rank: the least that this share of the values is not above.
double quantile(std::vector<double>& values, double share) {
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto at = values.begin() + std::max(0L, static_cast<std::ptrdiff_t>(rank) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Of numbers with this mean and this mean of their squares.
double standard_deviation(double mean, double square) {
  return std::sqrt(std::max(0.0, square - mean * mean));
}

/// Says how much of one direction is done.
struct Meter {
  const Progress& progress;
  std::string_view stage;
  double total;
  double done = 0;

  void advance(std::int64_t points) {
    done += static_cast<double>(points);
    report(progress, stage, std::min(1.0, done / total));
  }
};

/// What distances are measured to.
struct Target {
  const TriangleMesh& mesh;
  RayScene scene;
  std::optional<Border> border = {};  // none: what is nearest to it is not asked for
};

/// One surface's points on the way to another.
struct Direction {
  Side side;
  const TriangleMesh& from;
  const Target& to;
  const Enclosure* inside;  // none: sides are not asked for
  double noise;             // of samples; what is no farther is on the other surface
  double within;            // what is no farther is counted; less than 0: nothing is
  int threads;
  Meter meter;

  double deviation(double distance, const Vector3& point) const {
    const bool is_inside = inside && distance > noise && inside->holds(point);
    return is_inside ? -distance : distance;
  }

  bool leaves_out(double distance, const SurfacePoint& nearest) const {
    return to.border && distance > noise && to.border->holds(nearest);
  }

  /// measure(i, distance, nearest, point, tally) is told how far point_at(i) is from the other
  /// surface, and from where on it; where that is no more than `enough`, from any so near.
  template <class PointAt, class Measure>
  Tally measure(std::int64_t count, const PointAt& point_at, double enough,
                const Measure& measure) {
    Tally all;
    for (std::int64_t start = 0; start < count; start += block) {
      const std::int64_t points = std::min(block, count - start);
      std::vector<Tally> parts(static_cast<size_t>((points + chunk - 1) / chunk));
      parallel_for(points, chunk, threads, [&](std::int64_t first, std::int64_t last) {
        Tally& part = parts[static_cast<size_t>(first / chunk)];
        Face guess = -1;
        for (std::int64_t i = start + first; i < start + last; ++i) {
          const Vector3 point = point_at(i);
          const NearestPoint found = to.scene.nearest(point, guess, enough * enough);
          guess = found.on.face;
          measure(i, std::sqrt(found.squared_distance), found.on, point, part);
        }
      });
      for (const Tally& part : parts) all.add(part);
      meter.advance(points);
    }
    return all;
  }
};

/// Of the vertices that triangles use.
double largest_coordinate(const TriangleMesh& mesh) {
  double largest = 0;
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    const Vertex v = mesh.triangles.data()[i];
    largest = std::max(largest, mesh.positions.row(v).cwiseAbs().maxCoeff());
  }
  return largest;
}

std::vector<char> used_vertices(const TriangleMesh& mesh) {
  std::vector<char> used(static_cast<size_t>(mesh.vertex_count()), 0);
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    used[static_cast<size_t>(mesh.triangles.data()[i])] = 1;
  }
  return used;
}

/// `left_out`: a mark a vertex, where some may be.
Tally measure_vertices(Direction& direction, VertexDistances& result, VectorX& deviations,
                       std::vector<std::uint8_t>& left_out) {
  const TriangleMesh& other = direction.to.mesh;
  const std::vector<char> used = used_vertices(direction.from);
  deviations.resize(direction.inside ? direction.from.vertex_count() : 0);
  result.distances.resize(direction.from.vertex_count());
  result.nearest.resize(used.size());
  if (direction.to.border) left_out.resize(used.size());
  return direction.measure(
      direction.from.vertex_count(),
      [&](std::int64_t v) { return direction.from.position(static_cast<Vertex>(v)); }, 0,
      [&](std::int64_t v, double distance, const SurfacePoint& nearest, const Vector3& point,
          Tally& tally) {
        // From where squares are no numbers, which no used vertex is, all of the other is as far.
        result.distances[v] = std::isfinite(distance)
                                  ? distance
                                  : (point - other.position(other.triangles(0, 0))).stableNorm();
        result.nearest[static_cast<size_t>(v)] = nearest.face;
        const double deviation = direction.deviation(result.distances[v], point);
        if (direction.inside) deviations[v] = deviation;
        const bool leaves_out = direction.leaves_out(distance, nearest);
        if (leaves_out) left_out[static_cast<size_t>(v)] = 1;
        if (!used[static_cast<size_t>(v)]) return;
        if (leaves_out) {
          ++tally.left_out;
        } else {
          tally.add(distance, deviation, point);
          tally.near += distance <= direction.within;
        }
      });
}

template <class Samples>
Tally measure_samples(Direction& direction, const Samples& samples, Kept& kept) {
  const double noise = direction.noise;
  const std::int64_t first = kept.make_room(samples.count());
  return direction.measure(samples.count(), samples, noise,
                           [&](std::int64_t i, double distance, const SurfacePoint& nearest,
                               const Vector3& point, Tally& tally) {
                             if (direction.leaves_out(distance, nearest)) {
                               ++tally.left_out;
                               kept.leave_out(first, i);
                               return;
                             }
                             const double apart = distance <= noise ? 0 : distance;
                             const double deviation = direction.deviation(apart, point);
                             tally.add(apart, deviation, point);
                             tally.near += apart <= direction.within;
                             kept.put(first, i, apart, deviation);
                           });
}

/// Throws: UnmeasurableSurface where there is nothing to draw from.
template <class Samples>
Samples samples_of(const Direction& direction, const char* size,
                   const DistanceOptions& options) try {
  return Samples(direction.from, options.samples, options.seed);
} catch (const std::invalid_argument&) {
  throw UnmeasurableSurface(direction.side,
                            std::string("there is no ") + size + " to take samples of");
}

bool asks_vertices(const DistanceOptions& options) { return options.extremes || options.vertices; }

std::int64_t kept_stride(const TriangleMesh& mesh, const DistanceOptions& options) {
  const std::int64_t all = options.vertices * mesh.vertex_count() +
                           options.samples * (int{options.faces} + int{options.edges});
  return std::max<std::int64_t>(1, (all + most_kept - 1) / most_kept);
}

std::int64_t count_points(const TriangleMesh& mesh, const DistanceOptions& options) {
  return asks_vertices(options) * mesh.vertex_count() +
         options.samples * (int{options.faces} + int{options.edges});
}

/// The points of one side that were looked at: `samples`, those of mean and RMS, and all.
struct MeasuredPoints {
  VertexDistances at_vertices;
  VectorX deviations;                  // of vertices
  std::vector<std::uint8_t> left_out;  // marks of vertices, where some may be
  Tally samples, all;
  Kept kept;  // of samples
};

/// Every stride-th of the vertices that triangles use.
void keep_vertices(const Direction& direction, MeasuredPoints& points) {
  const std::vector<char> used = used_vertices(direction.from);
  const std::int64_t first = points.kept.make_room(std::count(used.begin(), used.end(), 1));
  std::int64_t i = 0;
  for (Eigen::Index v = 0; v < std::ssize(used); ++v) {
    if (!used[static_cast<size_t>(v)]) continue;
    if (!points.left_out.empty() && points.left_out[static_cast<size_t>(v)]) {
      points.kept.leave_out(first, i++);
      continue;
    }
    const double distance = points.at_vertices.distances[v];
    points.kept.put(first, i++, distance, direction.inside ? points.deviations[v] : distance);
  }
}

MeasuredPoints measure_points(Direction& direction, const DistanceOptions& options) {
  MeasuredPoints points;
  points.kept.stride = kept_stride(direction.from, options);
  if (asks_vertices(options))
    points.all =
        measure_vertices(direction, points.at_vertices, points.deviations, points.left_out);
  if (options.vertices) {
    points.samples.add(points.all);
    keep_vertices(direction, points);
  }
  if (options.edges) {
    const auto on_edges = samples_of<EdgeSamples>(direction, "length of edges", options);
    points.samples.add(measure_samples(direction, on_edges, points.kept));
  }
  if (options.faces) {
    const auto on_faces = samples_of<FaceSamples>(direction, "area", options);
    points.samples.add(measure_samples(direction, on_faces, points.kept));
  }
  points.all.add(points.samples);
  if (points.samples.count == 0)
    throw UnmeasurableSurface(direction.side,
                              "all of it is nearest to the border of the other, and left out");
  points.kept.forget_left_out();
  return points;
}

/// Of these points, and with `extremes` of what lies between them.
FarthestPoint farthest_of(const MeasuredPoints& points, const Direction& direction,
                          const DistanceOptions& options) {
  const FarthestPoint known{.point = points.all.farthest,
                            .distance = points.all.max,
                            .at_most = std::numeric_limits<double>::infinity()};
  if (!options.extremes || options.leave_out_borders) return known;
  return find_farthest(direction.from, points.at_vertices, direction.to.mesh, direction.to.scene,
                       known, options.samples, options.threads);
}

/// Takes the vertices' out of `points`. The farthest point counts with them.
SignedDeviation deviation_of(MeasuredPoints& points, const Direction& direction,
                             const OneSidedDistance& measured) {
  points.all.add_deviation(direction.deviation(measured.max, measured.farthest));
  const auto count = static_cast<double>(points.samples.count);
  const double mean = points.samples.signed_sum / count;
  return {.min = points.all.most_inside,
          .max = points.all.most_outside,
          .mean = mean,
          .sd = standard_deviation(mean, points.samples.squares / count),
          .median = quantile(points.kept.deviations, 0.5),
          .at_vertices = std::move(points.deviations)};
}

OneSidedDistance measure_one_side(Side side, const TriangleMesh& from, const Target& to,
                                  const Enclosure* inside, const DistanceOptions& options) {
  const std::string_view stage = side == Side::First ? "first to second" : "second to first";
  const auto points_in_all = static_cast<double>(count_points(from, options));
  Direction direction = {side,
                         from,
                         to,
                         inside,
                         sample_rounding * largest_coordinate(from),
                         options.within.value_or(-1),
                         options.threads,
                         {options.progress, stage, points_in_all}};
  MeasuredPoints points = measure_points(direction, options);
  const FarthestPoint farthest = farthest_of(points, direction, options);
  const bool is_noise = farthest.distance < direction.noise;
  const auto count = static_cast<double>(points.samples.count);
  const double mean = points.samples.sum / count, square = points.samples.squares / count;
  OneSidedDistance result = {.max = is_noise ? points.all.max : farthest.distance,
                             .max_bound = farthest.at_most,
                             .min = points.all.min,
                             .mean = mean,
                             .rms = std::sqrt(square),
                             .sd = standard_deviation(mean, square),
                             .median = quantile(points.kept.distances, 0.5),
                             .p95 = quantile(points.kept.distances, 0.95),
                             .p99 = quantile(points.kept.distances, 0.99),
                             .samples = points.samples.count,
                             .farthest = farthest.point,
                             .at_vertices = std::move(points.at_vertices.distances),
                             .left_out_vertices = std::move(points.left_out)};
  if (options.leave_out_borders) {
    const auto left_out = static_cast<double>(points.samples.left_out);
    result.left_out = left_out / (count + left_out);
  }
  if (options.within) result.within = static_cast<double>(points.samples.near) / count;
  if (inside) result.deviation = deviation_of(points, direction, result);
  return result;
}

void require_closed(const TriangleMesh& second) {
  const std::int64_t unclosed = unclosed_edges(second.triangles);
  if (unclosed == 0) return;
  throw UnmeasurableSurface(
      Side::Second,
      "it is not closed, so nothing is inside: " + counted(unclosed, "edge is", "edges are") +
          " open, or between faces that are turned against each other");
}

/// A power of two that brings the largest coordinate near 1, where squares would not be numbers;
/// else 1.
double common_scale(const TriangleMesh& first, const TriangleMesh& second) {
  const double largest = std::max(largest_coordinate(first), largest_coordinate(second));
  if (largest == 0 || (largest > smallest_unscaled && largest < largest_unscaled)) return 1;
  return std::ldexp(1.0, -std::clamp(std::ilogb(largest), -1000, 1000));
}

void scale_lengths(SurfaceDistance& distance, double scale) {
  for (OneSidedDistance* side : {&distance.forth, &distance.back}) {
    for (double* length : {&side->max, &side->max_bound, &side->min, &side->mean, &side->rms,
                           &side->sd, &side->median, &side->p95, &side->p99}) {
      *length *= scale;
    }
    side->farthest *= scale;
    side->at_vertices *= scale;
    if (!side->deviation) continue;
    SignedDeviation& deviation = *side->deviation;
    for (double* length :
         {&deviation.min, &deviation.max, &deviation.mean, &deviation.sd, &deviation.median})
      *length *= scale;
    deviation.at_vertices *= scale;
  }
  distance.diagonal_first *= scale;
  distance.diagonal_second *= scale;
}

SurfaceDistance measure_in_range(const TriangleMesh& first, const TriangleMesh& second,
                                 const DistanceOptions& options) {
  report(options.progress, "trees", 0);
  const auto border_of = [&](const TriangleMesh& mesh) {
    return options.leave_out_borders ? std::optional<Border>(mesh) : std::nullopt;
  };
  const Target to_first{first, RayScene(first), border_of(first)};
  report(options.progress, "trees", 0.5);
  const Target to_second{second, RayScene(second), border_of(second)};
  std::optional<Enclosure> inside;
  if (options.deviations) inside.emplace(options.enclosing ? *options.enclosing : second);
  const Enclosure* const enclosed = inside ? &*inside : nullptr;
  SurfaceDistance result;
  result.forth = measure_one_side(Side::First, first, to_second, enclosed, options);
  result.back = measure_one_side(Side::Second, second, to_first, nullptr, options);
  result.diagonal_first = to_first.scene.diagonal();
  result.diagonal_second = to_second.scene.diagonal();
  return result;
}

}  // namespace

double SurfaceDistance::max() const { return std::max(forth.max, back.max); }
double SurfaceDistance::max_bound() const { return std::max(forth.max_bound, back.max_bound); }
double SurfaceDistance::mean() const { return std::max(forth.mean, back.mean); }
double SurfaceDistance::rms() const { return std::max(forth.rms, back.rms); }
double SurfaceDistance::p95() const { return std::max(forth.p95, back.p95); }

SurfaceDistance measure_distance(const TriangleMesh& first, const TriangleMesh& second,
                                 const DistanceOptions& options) {
  require_measurable(first, Side::First);
  require_measurable(second, Side::Second);
  if (!(options.faces || options.edges || options.vertices) || options.samples < 1) {
    throw std::invalid_argument("measure_distance: no samples");
  }
  if (options.within && !(*options.within >= 0))
    throw std::invalid_argument("measure_distance: nothing is within less than 0");
  if (options.deviations) require_closed(options.enclosing ? *options.enclosing : second);
  const double scale = common_scale(first, second);
  if (scale == 1) return measure_in_range(first, second, options);
  DistanceOptions scaled = options;
  if (scaled.within) *scaled.within *= scale;
  TriangleMesh enclosing;
  if (options.enclosing) {
    enclosing = {scale * options.enclosing->positions, options.enclosing->triangles};
    scaled.enclosing = &enclosing;
  }
  SurfaceDistance result = measure_in_range({scale * first.positions, first.triangles},
                                            {scale * second.positions, second.triangles}, scaled);
  scale_lengths(result, 1 / scale);
  return result;
}

}  // namespace sphparam
