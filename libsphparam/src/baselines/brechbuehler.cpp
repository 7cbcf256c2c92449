#include "sphparam/baselines/brechbuehler.h"

#include <algorithm>
#include <utility>

#include "baselines/equal_areas.h"
#include "baselines/harmless_mesh.h"
#include "baselines/outcome.h"
#include "mesh/triangle_geometry.h"
#include "option_domain.h"
#include "sphparam/sphere/spherical_coordinates.h"

// (ϕ, θ) by two solves → sphere → for ρ = 1, 4, 16, … : damped Gauss–Newton steps. A step is taken
// if it lowers the merit and turns no angle negative; then damping falls. Faces that it would turn
// are held (active) as long as ρ stays; where that does not help, or the merit would rise, damping
// rises.
#include "number_text.h"

namespace sphparam {
namespace {

constexpr double first_damping = 1, least_damping = 1e-6, greatest_damping = 1e8;
constexpr double damping_up = 4, damping_down = 0.3;
constexpr double penalty_growth = 4;
constexpr double least_share = 1e-3;  // of the mean face: smaller faces count as this large

std::pair<Vertex, Vertex> extremes_of_z(const TriangleMesh& mesh) {
  std::pair<Vertex, Vertex> poles;
  mesh.positions.col(2).maxCoeff(&poles.first);
  mesh.positions.col(2).minCoeff(&poles.second);
  return poles;
}

SphereMap lifted(const LatitudeLongitude& coordinates) {
  SphereMap map{Points(coordinates.latitude.size(), 3)};
  for (Eigen::Index v = 0; v < map.points.rows(); ++v) {
    map.points.row(v) = to_cartesian({coordinates.longitude[v], coordinates.latitude[v]});
  }
  map.points.row(coordinates.date_line.front()) = Vector3(0, 0, 1);
  map.points.row(coordinates.date_line.back()) = Vector3(0, 0, -1);
  return map;
}

/// Each face's share of the surface's area.
std::vector<double> area_shares(const TriangleMesh& mesh) {
  std::vector<double> shares;
  double total = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    shares.push_back(face_area(mesh, f));
    total += shares.back();
  }
  const double least = total > 0 ? least_share * total / double(shares.size()) : 1;
  total = 0;
  for (double& share : shares) total += share = std::max(share, least);
  for (double& share : shares) share /= total;
  return shares;
}

struct Optimum {
  SphereMap map;
  int steps = 0;  // factorisations
  BaselineEnd end = BaselineEnd::IterationLimit;
};

class Optimiser {
 public:
  Optimiser(EqualAreas& problem, SphereMap map, const BrechbuehlerOptions& options)
      : problem_(problem),
        options_(options),
        result_{std::move(map)},
        negative_(problem.negative_angles(result_.map)),
        active_(negative_.size(), 0),
        merit_(problem.merit(result_.map, penalty_)) {}

  Optimum run(const Progress& progress) {
    while (result_.steps < options_.max_steps) {
      report(progress, "equal areas", double(result_.steps) / options_.max_steps);
      const double gain = try_step();
      if (damping_ > greatest_damping) {
        result_.end = BaselineEnd::Stalled;
        break;
      }
      if (gain >= options_.least_gain || gain < 0) continue;
      if (penalty_ >= options_.greatest_penalty) {
        result_.end = BaselineEnd::Converged;
        break;
      }
      penalty_ = std::min(options_.greatest_penalty, penalty_growth * penalty_);
      merit_ = problem_.merit(result_.map, penalty_);
      std::fill(active_.begin(), active_.end(), 0);
    }
    return std::move(result_);
  }

 private:
  /// The share by which the merit fell; −1 if the step was refused.
  double try_step() {
    SphereMap next =
        problem_.moved(result_.map, problem_.step(result_.map, penalty_, damping_, active_));
    ++result_.steps;
    const double merit = problem_.merit(next, penalty_);
    std::vector<char> negative = problem_.negative_angles(next);
    long violated = 0, activated = 0;
    for (size_t f = 0; f < negative.size(); ++f) {
      if (!negative[f] || negative_[f]) continue;
      ++violated;
      activated += active_[f] == 0;
      active_[f] = 1;
    }
    if (!(merit < merit_) || violated > 0) {
      if (activated == 0) damping_ *= damping_up;
      return -1;
    }
    const double gain = (merit_ - merit) / merit_;
    result_.map = std::move(next);
    negative_ = std::move(negative);
    merit_ = merit;
    damping_ = std::max(least_damping, damping_down * damping_);
    return gain;
  }

  EqualAreas& problem_;
  const BrechbuehlerOptions& options_;
  Optimum result_;
  std::vector<char> negative_;  // per face: negative at the start, and ever since
  std::vector<char> active_;    // per face: held, as a step would have turned it negative
  double penalty_ = 1, damping_ = first_damping, merit_;
};

const char* ending(BaselineEnd end) {
  if (end == BaselineEnd::Converged) return "optimal after ";
  return end == BaselineEnd::Stalled ? "no step is better after " : "not optimal after ";
}

}  // namespace

BaselineResult map_brechbuehler(const TriangleMesh& given, const Topology& topology,
                                const BrechbuehlerOptions& options, const Progress& progress) {
  if (options.poles) {
    require_vertex("poles: north", options.poles->first, given.vertex_count());
    require_vertex("poles: south", options.poles->second, given.vertex_count());
  }
  require_at_least("max_steps", options.max_steps, 0);
  require_between("least_gain", options.least_gain, 0, 1);
  require_at_least("greatest_penalty", options.greatest_penalty, 1);
  const HarmlessMesh harmless(given);
  const TriangleMesh& mesh = harmless.mesh;
  return run_rival([&](Outcome& outcome) {
    report(progress, "heat conduction", 0);
    const auto [north, south] = options.poles.value_or(extremes_of_z(mesh));
    const auto coordinates = conduct_heat(topology, north, south, options.threads);
    if (!coordinates) {
      return outcome.no_result("no longitude: poles " + std::to_string(north) + " and " +
                               std::to_string(south) +
                               " are adjacent, or latitude is flat in double precision");
    }
    SphereMap map = lifted(*coordinates);
    outcome.finish_stage("heat conduction");
    EqualAreas problem(topology, area_shares(mesh), options.threads);
    const double before = problem.area_error(map);
    Optimum optimum = Optimiser(problem, std::move(map), options).run(progress);
    outcome.finish_stage("equal areas", optimum.steps);
    const double after = problem.area_error(optimum.map);
    return outcome.take(std::move(optimum.map), optimum.end,
                        ending(optimum.end) + std::to_string(optimum.steps) +
                            " steps; area error " + short_number(before) + " before, " +
                            short_number(after) + " after");
  });
}

}  // namespace sphparam
