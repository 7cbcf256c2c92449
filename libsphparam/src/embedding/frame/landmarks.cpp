#include "embedding/frame/landmarks.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "elementary.h"
#include "embedding/constructions/orientations.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/frame/nearest_rotation.h"
#include "embedding/frame/pin_domain.h"
#include "embedding/frame/pinned_points.h"
#include "embedding/sweeps/relaxation.h"
#include "mesh/triangle_geometry.h"
#include "sphparam/parallel.h"
#include "sphparam/sphere/orientation.h"

// A round: (1) the field v(x) = Σ_j k(|x − x_j|) w_j, with v(x_i) the way of pin i, moves all
// vertices by the largest part 1, ½, ¼ … of it that folds nothing; (2) a pin whose point lies in
// the kernel of its ring goes there; (3) all other vertices relax. When no part of the field will
// do, pins go singly, each as far as the kernel of its ring lets it.

namespace sphparam {
namespace {

constexpr double influence_width = 0.5;  // radians: what a pin takes along with it
constexpr double longest_move = 0.3;     // radians in a round
constexpr double least_part = 1e-3;      // of a move: a shorter one is none
constexpr int patience = 15;             // rounds
constexpr double least_progress = 0.02;  // of the sum of residuals, within `patience` rounds
constexpr int detour_rounds = 5;         // moves aside
constexpr int detour_sweeps = 20;        // of relaxation before, with blocked pins let go
constexpr double right_turn = -1.2;      // radians; less than π/2: some of the way is gained too
constexpr double opposite = 1e-12;       // sine of an angle below which a great circle is undefined
constexpr std::int64_t grain = 256;

/// The tangent vector at `from` whose great circle reaches `to` after its length; 0 where they are
/// nearer to each other than rounding can tell.
Vector3 way(const Vector3& from, const Vector3& to) {
  const Vector3 side = to - from.dot(to) * from;
  const double sine = side.norm(), angle = angle_between(from, to);
  if (sine < opposite && angle > 1) return angle * from.unitOrthogonal();  // any will do
  if (angle == 0 || sine == 0) return Vector3::Zero();
  return angle / sine * side;
}

/// Once continuously differentiable (Matérn 3/2): pins that lie close keep the system regular.
double influence(double distance) {
  const double r = distance / influence_width;
  return (1 + r) * elementary::exp(-r);
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

class Traveller {
 public:
  Traveller(const Topology& topology, const RestTriangles& source, const SphereMap& map,
            const std::vector<Pin>& pins, const LandmarkOptions& options)
      : topology_(topology), source_(source), pins_(pins), options_(options) {
    result_.map = map;
    result_.residuals = pin_residuals(map, pins);
    const bool somewhere = std::ranges::count(result_.residuals, 0.0) == 0;
    if (somewhere) rotate(best_rotation(map, pins));
    snap();
  }

  LandmarkPlacement run() {
    start_ = std::max(sum(result_.residuals), std::numeric_limits<double>::min());
    while (!travel() && result_.detours < options_.most_detours &&
           result_.rounds < options_.most_rounds) {
      step_aside();
    }
    return std::move(result_);
  }

 private:
  void rotate(const Eigen::Matrix3d& rotation) {
    SphereMap rotated = normalised(result_.map.points * rotation.transpose());
    if (all_triangles_positive(topology_, rotated, options_.threads)) {
      result_.map = std::move(rotated);
    }
  }

  /// Rounds until all pins are where they should be (true), or stall.
  bool travel() {
    std::vector<double> history;
    const auto stalled = [&] {
      const size_t k = history.size();
      return k > patience && history[k - 1] > (1 - least_progress) * history[k - 1 - patience];
    };
    while (!result_.exact()) {
      if (stalled() || result_.rounds == options_.most_rounds) return false;
      ++result_.rounds;
      if (!flow(ways(0))) creep();
      snap();
      relax_with_pins_held(options_.sweeps);
      history.push_back(sum(result_.residuals));
      tell();
    }
    return true;
  }

  void tell() const {
    const double left = sum(result_.residuals);
    report(options_.progress, "pins", std::clamp(1 - left / start_, 0.0, 1.0));
  }

  void step_aside() {
    ++result_.detours;
    std::vector<Vertex> arrived;
    for (size_t i = 0; i < pins_.size(); ++i) {
      if (result_.residuals[i] == 0) arrived.push_back(pins_[i].vertex);
    }
    relax_around(std::move(arrived), detour_sweeps);
    for (int i = 0; i < detour_rounds; ++i) {
      flow(ways(right_turn));
      snap();
      relax_with_pins_held(options_.sweeps);
      tell();
    }
  }

  /// Each pin's way, cut to the longest move; with a turn, all that have a way left go that far.
  Eigen::MatrixXd ways(double turn) const {
    Eigen::MatrixXd result(std::ssize(pins_), 3);
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
      const Pin& pin = pins_[static_cast<size_t>(i)];
      const Vector3 x = result_.map.point(pin.vertex);
      Vector3 w = way(x, pin.point);
      if (turn != 0 && w.norm() > 0) {
        const Vector3 ahead = w.normalized(), aside = x.cross(ahead);
        w = longest_move * (elementary::cos(turn) * ahead + elementary::sin(turn) * aside);
      }
      result.row(i) = w;
    }
    const double longest = result.rowwise().norm().maxCoeff();
    return longest > longest_move ? Eigen::MatrixXd(longest_move / longest * result) : result;
  }

  /// Moves all vertices by the field that takes the pins along `ways`, or by a part of it.
  bool flow(const Eigen::MatrixXd& ways) {
    const Points field = interpolate(ways);
    for (double part = 1; part > least_part; part /= 2) {
      SphereMap moved = normalised(result_.map.points + part * field);
      if (!all_triangles_positive(topology_, moved, options_.threads)) continue;
      result_.map = std::move(moved);
      return true;
    }
    return false;
  }

  /// v(x) = Σ_j k(|x − x_j|) w_j, less its normal part, with w from v(x_i) = ways_i.
  Points interpolate(const Eigen::MatrixXd& ways) const {
    const Points& x = result_.map.points;
    const Eigen::Index count = ways.rows();
    Points at_pins(count, 3);
    for (Eigen::Index j = 0; j < count; ++j) {
      at_pins.row(j) = x.row(pins_[static_cast<size_t>(j)].vertex);
    }
    const auto influence_of = [&](const Points& points, Eigen::Index i, Eigen::Index j) {
      return influence((points.row(i) - at_pins.row(j)).norm());
    };
    const Eigen::MatrixXd influences = Eigen::MatrixXd::NullaryExpr(
        count, count, [&](Eigen::Index i, Eigen::Index j) { return influence_of(at_pins, i, j); });
    const Eigen::MatrixXd weights = influences.ldlt().solve(ways);
    tell();  // with a thousand pins all of this takes long
    Points field(x.rows(), 3);
    parallel_for(x.rows(), grain, options_.threads, [&](std::int64_t first, std::int64_t last) {
      for (Eigen::Index v = first; v < last; ++v) {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (Eigen::Index j = 0; j < count; ++j) sum += influence_of(x, v, j) * weights.row(j);
        field.row(v) = sum - sum.dot(x.row(v)) * x.row(v);
      }
    });
    return field;
  }

  bool move_if_positive(Vertex v, const Vector3& to) {
    const Vector3 from = result_.map.point(v);
    result_.map.points.row(v) = to;
    if (ring_is_positive(topology_, result_.map, v)) return true;
    result_.map.points.row(v) = from;
    return false;
  }

  void snap() {
    for (const Pin& pin : pins_) move_if_positive(pin.vertex, pin.point);
    result_.residuals = pin_residuals(result_.map, pins_);
  }

  /// Each pin goes half as far as its ring allows, so as not to lie on the border of the kernel.
  void creep() {
    for (const Pin& pin : pins_) {
      const Vector3 x = result_.map.point(pin.vertex), w = way(x, pin.point);
      for (double part = 0.5; part > least_part; part /= 2) {
        if (!move_if_positive(pin.vertex, (x + part * w).normalized())) continue;
        move_if_positive(pin.vertex, (x + part / 2 * w).normalized());
        break;
      }
    }
  }

  void relax_with_pins_held(int sweeps) {
    std::vector<Vertex> held;
    for (const Pin& pin : pins_) held.push_back(pin.vertex);
    relax_around(std::move(held), sweeps);
  }

  void relax_around(std::vector<Vertex> held, int sweeps) {
    result_.map = relax(topology_, source_, result_.map,
                        {.energy = options_.energy,
                         .sweeps = sweeps,
                         .pinned = std::move(held),
                         .threads = options_.threads})
                      .map;
  }

  const Topology& topology_;
  const RestTriangles& source_;
  const std::vector<Pin>& pins_;
  const LandmarkOptions& options_;
  LandmarkPlacement result_;
  double start_ = 0;  // sum of residuals
};

}  // namespace

std::optional<Face> face_folded_by(const Topology& topology, const std::vector<Pin>& pins) {
  std::unordered_map<Vertex, Vector3> points;
  for (const Pin& pin : pins) points.emplace(pin.vertex, pin.point);
  std::optional<Face> folded;
  for (const Pin& pin : pins) {
    topology.for_each_outgoing(pin.vertex, [&](Halfedge h) {
      const auto next = points.find(topology.target(h)), last = points.find(topology.apex(h));
      if (next == points.end() || last == points.end()) return;
      if (orientation(pin.point, next->second, last->second) <= 0) folded = Topology::face(h);
    });
    if (folded) break;
  }
  return folded;
}

bool LandmarkPlacement::exact() const { return all_exact(residuals); }

bool all_exact(const std::vector<double>& residuals) {
  return !residuals.empty() && std::ranges::all_of(residuals, [](double r) { return r == 0; });
}

Eigen::Matrix3d best_rotation(const SphereMap& map, const std::vector<Pin>& pins) {
  const PinnedPoints points = pinned_points(map, pins);
  return best_rotation(points.from, points.to);
}

Eigen::Matrix3d best_rotation(const Points& from, const Points& to) {
  return rotation_of(to.transpose() * from);
}

std::vector<double> pin_residuals(const SphereMap& map, const std::vector<Pin>& pins) {
  std::vector<double> residuals;
  for (const Pin& pin : pins) {
    const Vector3 x = map.point(pin.vertex);
    const double angle = angle_between(x, pin.point);
    residuals.push_back(x == pin.point ? 0 : std::max(angle, std::numeric_limits<double>::min()));
  }
  return residuals;
}

LandmarkPlacement place_landmarks(const Topology& topology, const RestTriangles& source,
                                  const SphereMap& map, const std::vector<Pin>& pins,
                                  const LandmarkOptions& options) {
  require_domain(options.energy);
  require_at_least("sweeps", options.sweeps, 0);
  require_at_least("most_rounds", options.most_rounds, 0);
  require_at_least("most_detours", options.most_detours, 0);
  require_pins(pins, topology.vertex_count());
  if (pins.empty()) return {.map = map};
  return Traveller(topology, source, map, pins, options).run();
}

}  // namespace sphparam
