#include "sphparam/baselines/tangential.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "baselines/harmless_mesh.h"
#include "baselines/outcome.h"
#include "baselines/weighted_rings.h"
#include "elementary.h"
#include "mesh/triangle_geometry.h"
#include "option_domain.h"
#include "sphere/face_rays.h"
#include "sphparam/mesh/edge_weights.h"
#include "sphparam/parallel.h"

// x_i ← x_i + (I − x_i x_iᵀ) 𝓛(x_i), 𝓛(x_i) = Σ_j w_ij x_j / Σ_j w_ij − x_i; x_i ← x_i / |x_i|,
// vertex after vertex, but for the anchors.

namespace sphparam {
namespace {

constexpr int check_every = 20;  // sweeps between two looks at folds
constexpr int anchor_sets = 4;   // of anchors; a map that rests with all of them has ended
constexpr std::int64_t grain = 4096;

/// From the surface's centre of area to the sphere.
SphereMap central_projection(const TriangleMesh& mesh) {
  Vector3 centre = Vector3::Zero();
  double total = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto t = mesh.triangles.row(f);
    const Vector3 a = mesh.position(t[0]), b = mesh.position(t[1]), c = mesh.position(t[2]);
    const double area = doubled_area(a, b, c);
    centre += area * (a + b + c) / 3;
    total += area;
  }
  centre = total > 0 ? Vector3(centre / total) : Vector3(mesh.positions.colwise().mean());
  SphereMap map{mesh.positions.rowwise() - centre.transpose()};
  for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
    const double length = map.points.row(v).norm();
    if (length > 0) {
      map.points.row(v) /= length;
    } else {
      map.points.row(v) << 0, 0, 1;
    }
  }
  return map;
}

/// The corners of a tetrahedron, of its mirror image, or of one of them turned by an eighth about
/// z: four sets, in turn.
std::array<Vector3, 4> tetrahedron(int turn) {
  const double sign = turn % 2 == 0 ? 1 : -1;
  const double angle = turn / 2 % 2 == 0 ? 0 : std::numbers::pi / 4;
  const double c = elementary::cos(angle), s = elementary::sin(angle);
  const auto turned = [&](const Vector3& x) {
    return Vector3(c * x.x() - s * x.y(), s * x.x() + c * x.y(), x.z());
  };
  std::array<Vector3, 4> corners = {Vector3(1, 1, 1), Vector3(1, -1, -1), Vector3(-1, 1, -1),
                                    Vector3(-1, -1, 1)};
  for (Vector3& corner : corners) corner = sign * turned(corner).normalized();
  return corners;
}

/// Takes the nearest vertex to each corner. Returns 1 per vertex that is held.
std::vector<char> choose_anchors(const SphereMap& map, const std::array<Vector3, 4>& corners) {
  std::vector<char> held(static_cast<size_t>(map.points.rows()), 0);
  for (const Vector3& corner : corners) {
    Vertex nearest = 0;
    (map.points * corner).maxCoeff(&nearest);
    held[static_cast<size_t>(nearest)] = 1;
  }
  return held;
}

long count_folds(const Topology& topology, const SphereMap& map, int threads) {
  const auto of_chunk = [&](std::int64_t first, std::int64_t last) {
    long folds = 0;
    for (Face f = static_cast<Face>(first); f < last; ++f) {
      folds += face_orientation(topology, map, f) <= 0;
    }
    return double(folds);
  };
  return std::lround(parallel_sum(topology.face_count(), threads, of_chunk));
}

class Smoothing {
 public:
  Smoothing(const TriangleMesh& mesh, const Topology& topology, const TangentialOptions& options)
      : topology_(topology),
        options_(options),
        rings_(topology, weights(mesh, topology, options)),
        map_(central_projection(mesh)) {
    for (Vertex i = 0; i < rings_.vertex_count(); ++i) totals_.push_back(rings_.total(i));
    check();
  }

  void run(const Progress& progress) {
    do {
      held_ = choose_anchors(map_, tetrahedron(sets_++));
      const int sweeps = smooth_round(progress);
      sets_at_rest_ = sweeps <= 1 ? sets_at_rest_ + 1 : 0;
      check();
    } while (!last_valid_ && sweeps_ < options_.max_sweeps && sets_at_rest_ < anchor_sets);
  }

  int sweeps() const { return sweeps_; }

  BaselineResult result(Outcome& outcome) {
    const std::string after = " after " + std::to_string(sweeps_) + " sweeps and " +
                              std::to_string(sets_) + " sets of anchors";
    if (last_valid_) {
      return outcome.take(
          std::move(*last_valid_), BaselineEnd::Converged,
          "no triangle is folded" + after + (folds_ > 0 ? "; more sweeps fold some" : ""));
    }
    const bool rests = sets_at_rest_ == anchor_sets;
    return outcome.take(std::move(map_), rests ? BaselineEnd::Stalled : BaselineEnd::IterationLimit,
                        (rests ? "the map rests; " : "") + std::to_string(folds_) +
                            " triangles are folded" + after);
  }

 private:
  static std::vector<double> weights(const TriangleMesh& mesh, const Topology& topology,
                                     const TangentialOptions& options) {
    if (options.laplacian == TangentialOptions::Operator::Uniform) return {};
    return EdgeWeights(mesh, topology, WeightKind::MeanValue, options.threads)
        .with(topology, {}, options.threads);
  }

  /// Sweeps with the same anchors, at least one. Returns their number.
  int smooth_round(const Progress& progress) {
    int sweeps = 0;
    double move = 1;
    while (sweeps < options_.sweeps_per_anchors && sweeps_ < options_.max_sweeps &&
           move > options_.rest) {
      if (sweeps % check_every == 0) {
        report(progress, "tangential smoothing", double(sweeps_) / options_.max_sweeps);
        if (sweeps > 0) check();
        if (last_valid_ && folds_ > 0) break;
      }
      move = sweep();
      ++sweeps;
      ++sweeps_;
    }
    return sweeps;
  }

  /// The longest move.
  double sweep() {
    double longest2 = 0;
    for (Vertex i = 0; i < rings_.vertex_count(); ++i) {
      if (held_[static_cast<size_t>(i)]) continue;
      const Vector3 x = map_.point(i);
      const Vector3 step = rings_.pull(map_.points, i) / totals_[static_cast<size_t>(i)];
      const Vector3 moved = (x + (step - step.dot(x) * x)).normalized();
      longest2 = std::max(longest2, (moved - x).squaredNorm());
      map_.points.row(i) = moved;
    }
    return std::sqrt(longest2);
  }

  void check() {
    folds_ = count_folds(topology_, map_, options_.threads);
    if (folds_ == 0) last_valid_ = map_;
  }

  const Topology& topology_;
  const TangentialOptions& options_;
  const WeightedRings rings_;
  std::vector<double> totals_;  // Σ_j w_ij
  SphereMap map_;
  std::optional<SphereMap> last_valid_;
  std::vector<char> held_;  // per vertex: an anchor
  long folds_ = 0;
  int sweeps_ = 0, sets_ = 0, sets_at_rest_ = 0;
};

}  // namespace

BaselineResult map_tangential(const TriangleMesh& given, const Topology& topology,
                              const TangentialOptions& options, const Progress& progress) {
  require_one_of("laplacian", options.laplacian, TangentialOptions::Operator::Uniform);
  require_at_least("max_sweeps", options.max_sweeps, 0);
  require_at_least("sweeps_per_anchors", options.sweeps_per_anchors, 1);
  require_at_least("rest", options.rest, 0);
  const HarmlessMesh harmless(given);
  Outcome outcome;
  Smoothing smoothing(harmless.mesh, topology, options);
  outcome.finish_stage("central projection");
  smoothing.run(progress);
  outcome.finish_stage("tangential smoothing", smoothing.sweeps());
  return smoothing.result(outcome);
}

}  // namespace sphparam
