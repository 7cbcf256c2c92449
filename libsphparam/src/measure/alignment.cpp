// In coordinates in which the first surface is as large as 1 and about 0. A sample of the first is
// brought into the second's coordinates to ask for the nearest point there, so that both trees stay
// as they are. Each step moves the points q of the second to the p of the first that they belong
// to:
//
//   Σ (n · (q + ω × (q − c) + σ (q − c) + τ − p))²  least,  n the normal where the nearest point is
//
// or, where that comes no nearer, Σ |s R (q − c) + t − p|² least, which always does: of all steps
// Σ min(d², reach²) gets less, and the reach no larger, so that it ends.

#include "sphparam/measure/alignment.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "embedding/frame/nearest_rotation.h"
#include "measure/measurable_side.h"
#include "measure/surface_samples.h"
#include "mesh/box.h"
#include "rays/flat_normal.h"
#include "rays/interpolation.h"
#include "rays/ray_scene.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

using Eigen::Matrix3d;

constexpr std::int64_t samples_to_choose = 500;  // from which start to go on
/// When to stop: steps, and the share of what is left by which a step that is worth it is less.
struct Patience {
  int steps;
  double share;
};
constexpr Patience to_choose = {30, 1e-3}, to_settle = {200, 1e-6};
constexpr double close = 0.002;   // as they are, means of so much need no other start
constexpr double much = 0.5;      // times as far: another start is worth it
constexpr double outlier = 4.45;  // medians: 3 standard deviations of errors along normals
constexpr double least_reach = 1e-6;
constexpr double noise = 1e-15;        // RMS of what rounding leaves
constexpr double undetermined = 1e-6;  // of the largest eigenvalue
constexpr double largest = 1e100;
constexpr std::int64_t grain = 64;
constexpr char stage[] = "aligning";
constexpr double choosing = 0.5;  // of the work, for the progress

/// A sample and its nearest point: q of the second, moved, p of the first.
struct Pair {
  Vector3 q, p, normal;
  double distance;
  Face face;  // that the nearest point lies on
};
using Pairs = std::vector<Pair>;

Vector3 face_normal(const TriangleMesh& mesh, Face face) {
  const auto corners = mesh.triangles.row(face);
  return flat_normal(mesh.position(corners[0]), mesh.position(corners[1]),
                     mesh.position(corners[2]));
}

Vector3 place_of(const TriangleMesh& mesh, const SurfacePoint& point) {
  return interpolate(mesh.positions, mesh.triangles, point);
}

/// What a surface of its own coordinates is in the common ones, and samples of it.
struct Surface {
  TriangleMesh mesh;
  RayScene scene;

  Surface(const TriangleMesh& own, const Vector3& centre, double size, Side side)
      : mesh(within_range(own, centre, size, side)), scene(mesh) {}

  static TriangleMesh within_range(const TriangleMesh& own, const Vector3& centre, double size,
                                   Side side) {
    TriangleMesh mesh = {(own.positions.rowwise() - centre.transpose()) / size, own.triangles};
    const Box box = surface_box(mesh);
    const double far = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    if (!(mesh.positions.allFinite() && far < largest && box.longest_side() > 1 / largest))
      throw UnmeasurableSurface(side, "it is too far away, too large or too small to be aligned");
    return mesh;
  }
};

Points samples_of(const Surface& surface, Side side, std::int64_t count, std::uint64_t seed) try {
  const FaceSamples samples(surface.mesh, count, seed);
  Points points(count, 3);
  for (std::int64_t i = 0; i < count; ++i) points.row(i) = samples(i);
  return points;
} catch (const std::invalid_argument&) {
  throw UnmeasurableSurface(side, "there is no area to take samples of");
}

Similarity inverse(const Similarity& motion) {
  const Matrix3d back = motion.rotation.transpose();
  return {1 / motion.scale, back, -(back * motion.shift) / motion.scale};
}

/// First `inner`, then `outer`.
Similarity composed(const Similarity& outer, const Similarity& inner) {
  return {outer.scale * inner.scale, rotation_of(outer.rotation * inner.rotation),
          outer(inner.shift)};
}

double square(double x) { return x * x; }

double median_distance(const Pairs& pairs) {
  std::vector<double> distances(pairs.size());
  std::ranges::transform(pairs, distances.begin(), &Pair::distance);
  const auto middle = distances.begin() + std::ssize(distances) / 2;
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

double mean_distance(const Pairs& pairs) {
  double sum = 0;
  for (const Pair& pair : pairs) sum += pair.distance;
  return sum / static_cast<double>(pairs.size());
}

double cost_of(const Pairs& pairs, double reach) {
  double sum = 0;
  for (const Pair& pair : pairs) sum += square(std::min(pair.distance, reach));
  return sum;
}

/// Where a motion has come to.
struct State {
  Similarity motion;
  Pairs pairs;
  double reach = 0;
  int steps = 0;

  double cost() const { return cost_of(pairs, reach); }
};

/// Moments of the pairs within reach.
struct Moments {
  Vector3 q = Vector3::Zero(), p = Vector3::Zero();  // means
  Matrix3d covariance = Matrix3d::Zero();            // Σ (p − p̄)(q − q̄)ᵀ
  double spread = 0;                                 // Σ |q − q̄|²
  double count = 0;
};

Moments moments_of(const State& state) {
  Moments moments;
  const auto each = [&](const auto& add) {
    for (const Pair& pair : state.pairs)
      if (pair.distance <= state.reach) add(pair);
  };
  each([&](const Pair& pair) { moments.q += pair.q, moments.p += pair.p, ++moments.count; });
  moments.q /= moments.count, moments.p /= moments.count;
  each([&](const Pair& pair) {
    const Vector3 q = pair.q - moments.q;
    moments.covariance += (pair.p - moments.p) * q.transpose();
    moments.spread += q.squaredNorm();
  });
  return moments;
}

/// About `centre`, and then by `shift` on.
Similarity about(const Vector3& centre, double scale, const Matrix3d& rotation,
                 const Vector3& shift) {
  return {scale, rotation, centre + shift - scale * (rotation * centre)};
}

Similarity step_to_points(const State& state, bool scales) {
  const Moments moments = moments_of(state);
  const Matrix3d rotation = rotation_of(moments.covariance);
  double scale = 1;
  if (scales && moments.spread > 0)
    scale = (rotation.transpose() * moments.covariance).trace() / moments.spread;
  if (!(scale > 0)) scale = 1;
  return about(moments.q, scale, rotation, moments.p - moments.q);
}

using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

/// The least of least solutions: nothing along eigenvectors that nothing decides.
Vector7 solved(const Matrix7& matrix, const Vector7& right) {
  const Eigen::SelfAdjointEigenSolver<Matrix7> solver(matrix);
  const Vector7& values = solver.eigenvalues();
  Vector7 parts = solver.eigenvectors().transpose() * right;
  for (int i = 0; i < 7; ++i)
    parts[i] = values[i] > undetermined * values[6] ? parts[i] / values[i] : 0;
  return solver.eigenvectors() * parts;
}

/// The turn by a small vector, to second order, and exactly a turn (Cayley).
Matrix3d turn_by(const Vector3& vector) {
  return Eigen::Quaterniond(1, vector.x() / 2, vector.y() / 2, vector.z() / 2)
      .normalized()
      .toRotationMatrix();
}

Similarity step_to_planes(const State& state, bool scales) {
  const Moments moments = moments_of(state);
  Matrix7 matrix = Matrix7::Zero();
  Vector7 right = Vector7::Zero();
  for (const Pair& pair : state.pairs) {
    if (pair.distance > state.reach) continue;
    const Vector3 arm = pair.q - moments.q;
    Vector7 row;
    row << arm.cross(pair.normal), pair.normal, scales ? pair.normal.dot(arm) : 0;
    matrix += row * row.transpose();
    right += row * pair.normal.dot(pair.p - pair.q);
  }
  const Vector7 step = solved(matrix, right);
  return about(moments.q, std::max(1 + step[6], 0.5), turn_by(step.head<3>()), step.segment<3>(3));
}

class Aligner {
 public:
  Aligner(const Surface& first, const Surface& second, std::int64_t samples,
          const AlignmentOptions& options)
      : first_(first),
        second_(second),
        options_(options),
        of_first_(samples_of(first, Side::First, samples, options.seed)),
        of_second_(samples_of(second, Side::Second, samples, options.seed)) {}

  const Points& of_first() const { return of_first_; }
  const Points& of_second() const { return of_second_; }

  State at(const Similarity& motion) const {
    State state{motion, pairs(motion, {})};
    state.reach = std::max(outlier * median_distance(state.pairs), least_reach);
    return state;
  }

  /// `done`: of all the work, before it.
  State settled_from(const Similarity& start, const Patience& patience, double done) const {
    State state = at(start);
    while (state.steps < patience.steps && advance(state, patience.share))
      report(options_.progress, stage, done);
    return state;
  }

 private:
  /// False where it comes hardly nearer.
  bool advance(State& state, double share) const {
    const double before = state.cost();
    if (before <= square(noise) * static_cast<double>(state.pairs.size())) return false;
    if (!take(state, step_to_planes(state, options_.scale)) &&
        !take(state, step_to_points(state, options_.scale)))
      return false;
    ++state.steps;
    const bool goes_on = state.cost() < (1 - share) * before;
    state.reach =
        std::min(state.reach, std::max(outlier * median_distance(state.pairs), least_reach));
    return goes_on;
  }

  bool take(State& state, const Similarity& step) const {
    const Similarity motion = composed(step, state.motion);
    Pairs found = pairs(motion, state.pairs);
    if (!(cost_of(found, state.reach) < state.cost())) return false;
    state.motion = motion;
    state.pairs = std::move(found);
    return true;
  }

  Pair forth(const Vector3& point, const Similarity& motion, const Similarity& back,
             Face guess) const {
    const SurfacePoint on = second_.scene.nearest(back(point), guess).on;
    const Vector3 q = motion(place_of(second_.mesh, on));
    return {q, point, motion.rotation * face_normal(second_.mesh, on.face), (q - point).norm(),
            on.face};
  }

  Pair back(const Vector3& point, const Similarity& motion, Face guess) const {
    const Vector3 q = motion(point);
    const SurfacePoint on = first_.scene.nearest(q, guess).on;
    const Vector3 p = place_of(first_.mesh, on);
    return {q, p, face_normal(first_.mesh, on.face), (q - p).norm(), on.face};
  }

  /// `before`: of a motion that is not far from it, or none.
  Pairs pairs(const Similarity& motion, const Pairs& before) const {
    const Similarity inverted = inverse(motion);
    const std::int64_t there = of_first_.rows(), all = there + of_second_.rows();
    Pairs result(static_cast<size_t>(all));
    parallel_for(all, grain, options_.threads, [&](std::int64_t from, std::int64_t to) {
      for (std::int64_t i = from; i < to; ++i) {
        const auto at = static_cast<size_t>(i);
        const Face guess = before.empty() ? -1 : before[at].face;
        result[at] = i < there ? forth(of_first_.row(i), motion, inverted, guess)
                               : back(of_second_.row(i - there), motion, guess);
      }
    });
    return result;
  }

  const Surface& first_;
  const Surface& second_;
  const AlignmentOptions& options_;
  Points of_first_, of_second_;
};

/// Centroid, RMS distance from it, and axes, columns that are right-handed.
struct Frame {
  Vector3 centre;
  double size;
  Matrix3d axes;

  explicit Frame(const Points& points) : centre(points.colwise().mean()) {
    const Points about = points.rowwise() - centre.transpose();
    const Matrix3d covariance = about.transpose() * about / static_cast<double>(points.rows());
    size = std::sqrt(covariance.trace());
    axes = Eigen::SelfAdjointEigenSolver<Matrix3d>(covariance).eigenvectors();
    if (axes.determinant() < 0) axes.col(2) *= -1;
  }
};

/// The 24 turns that bring axes onto axes.
std::vector<Matrix3d> turns_of_axes() {
  std::vector<Matrix3d> turns;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      if (x % 3 == y % 3) continue;
      Matrix3d turn;
      turn.col(0) = (x < 3 ? 1 : -1) * Vector3::Unit(x % 3);
      turn.col(1) = (y < 3 ? 1 : -1) * Vector3::Unit(y % 3);
      turn.col(2) = turn.col(0).cross(turn.col(1));
      turns.push_back(turn);
    }
  }
  return turns;
}

struct Start {
  Similarity motion;
  AlignmentStart kind;
};

std::vector<Start> other_starts(const Aligner& aligner, bool scales) {
  const Frame first(aligner.of_first()), second(aligner.of_second());
  const double scale = scales ? first.size / second.size : 1;
  const auto start = [&](const Matrix3d& turn) {
    return about(second.centre, scale, turn, first.centre - second.centre);
  };
  std::vector<Start> starts = {{start(Matrix3d::Identity()), AlignmentStart::Centroids}};
  for (const Matrix3d& turn : turns_of_axes())
    starts.push_back(
        {start(first.axes * turn * second.axes.transpose()), AlignmentStart::PrincipalAxes});
  return starts;
}

/// By few samples.
Start best_start(const Aligner& aligner, const AlignmentOptions& options) {
  Start best = {Similarity(), AlignmentStart::AsTheyAre};
  const State as_they_are = aligner.settled_from(best.motion, to_choose, 0);
  double least = mean_distance(as_they_are.pairs);
  if (least <= close) return best;
  least *= much;
  const std::vector<Start> starts = other_starts(aligner, options.scale);
  for (size_t i = 0; i < starts.size(); ++i) {
    const double done = choosing * static_cast<double>(i) / static_cast<double>(starts.size());
    const State state = aligner.settled_from(starts[i].motion, to_choose, done);
    const double mean = mean_distance(state.pairs);
    if (!(mean < least)) continue;
    least = mean;
    best = {state.motion, starts[i].kind};
  }
  return best;
}

/// In the surfaces' own coordinates.
Similarity as_given(const Similarity& motion, const Vector3& centre, double size) {
  return {motion.scale, motion.rotation,
          (centre - motion.scale * (motion.rotation * centre)) + size * motion.shift};
}

Alignment told(const State& state, AlignmentStart start, const Vector3& centre, double size,
               bool scaled) {
  double squares = 0, kept = 0;
  for (const Pair& pair : state.pairs) {
    if (pair.distance > state.reach) continue;
    squares += square(pair.distance);
    ++kept;
  }
  return {.motion = as_given(state.motion, centre, size),
          .scaled = scaled,
          .start = start,
          .reach = size * state.reach,
          .kept = kept / static_cast<double>(state.pairs.size()),
          .rms = size * std::sqrt(squares / kept),
          .iterations = state.steps};
}

}  // namespace

const char* name_of(AlignmentStart start) {
  switch (start) {
    case AlignmentStart::AsTheyAre:
      return "as they are";
    case AlignmentStart::Centroids:
      return "centroids";
    case AlignmentStart::PrincipalAxes:
      return "principal axes";
  }
  throw std::invalid_argument("no start of an alignment");
}

Alignment align_surfaces(const TriangleMesh& first, const TriangleMesh& second,
                         const AlignmentOptions& options) {
  if (options.samples < 1) throw std::invalid_argument("align_surfaces: no samples");
  require_measurable(first, Side::First);
  require_measurable(second, Side::Second);
  report(options.progress, stage, 0);
  const Box box = surface_box(first);
  const Vector3 centre = box.lower / 2 + box.upper / 2;
  const double size = (box.upper - box.lower).stableNorm();
  const Surface one(first, centre, size, Side::First), other(second, centre, size, Side::Second);
  const Start start = best_start(
      Aligner(one, other, std::min(options.samples, samples_to_choose), options), options);
  const State state =
      Aligner(one, other, options.samples, options).settled_from(start.motion, to_settle, choosing);
  report(options.progress, stage, 1);
  return told(state, start.kind, centre, size, options.scale);
}

}  // namespace sphparam
