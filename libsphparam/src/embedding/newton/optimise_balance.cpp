#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "embedding/energy/energy_domain.h"
#include "embedding/energy/map_image.h"
#include "embedding/energy/solid_angle_aim.h"
#include "embedding/newton/even_areas.h"
#include "embedding/newton/global_newton.h"
#include "embedding/newton/minimise.h"
#include "embedding/newton/optimise.h"

// From λ to λ, each time from the map before. Equal areas are areas of spherical triangles, where
// the energy has determinants: where triangles are large its areas are corrected on the way. Where
// a swift climb ends without equal areas, a slow one from the same start often does not: areas that
// are to travel along a rod need many steps at each λ. Solids of a few triangles, some of a quarter
// of the sphere and more, are beyond corrections: their areas are made even without an energy.
// Angles alone leave areas free: limbs end at 1e-14 of the sphere for the last per cent of an
// angle. So λ is not the least one, but such that areas weigh next to nothing of what angles still
// miss. A nearly conformal map is one descent from there.

namespace sphparam {
namespace {

constexpr double factor_down = 0.1;
constexpr double weight_of_areas = 3e-3;  // of what the angles miss, in a conformal map
constexpr double greatest_conformal_lambda = 0.1;
constexpr double coarse_areas = 5e-3;  // mean |log2| of a determinant over twice a solid angle
constexpr double steep_lambda = 1e4;   // beyond it a factor of λ that changes no area is the last
constexpr double idle_climb = 0.01;    // of the area error
constexpr int most_evened_out = 4000;  // vertices: each step is a sparse factorisation

/// How one factor of λ is made.
struct Climb {
  double factor, gain;
  int steps;
};
constexpr Climb swift{4, 1e-2, 12}, slow{2, 1e-3, 60};

/// Takes a map from λ to λ.
class Continuation {
 public:
  Continuation(const Topology& topology, const RestTriangles& source, const SphereMap& map,
               const BalanceOptions& options)
      : topology_(topology),
        source_(source),
        options_(options),
        lambda_(options.from_lambda),
        image_(image_of(map)) {
    lay_out(source_);
  }

  BalancedMap run() {
    switch (options_.balance) {
      case Balance::Lambda:
        while (lambda_ != options_.optimise.energy.lambda) {
          go(options_.optimise.energy.lambda, swift);
        }
        settle(options_.optimise);
        break;
      case Balance::EqualArea:
        go_equal_area();
        break;
      case Balance::Conformal:
        go_conformal();
        break;
    }
    return {map_of(image_), lambda_, error_of_areas(), report_, std::move(aim_)};
  }

 private:
  void lay_out(const RestTriangles& source) {
    isometric_areas_ = isometric_energy(source, {.lambda = 0}, {});
    newton_.emplace(topology_, source, image_, options_.optimise.pinned, options_.optimise.threads);
  }

  /// One factor of λ towards the aim.
  void go(double aim, const Climb& climb) {
    lambda_ = aim < lambda_ ? std::max(aim, lambda_ * factor_down)
                            : std::min(aim, lambda_ * climb.factor);
    OptimiseOptions rough = options_.optimise;
    rough.least_gain = std::max(rough.least_gain, climb.gain);
    rough.max_steps = std::min(rough.max_steps, climb.steps);
    settle(rough);
  }

  void settle(OptimiseOptions how) {
    how.energy.lambda = lambda_;
    minimise(*newton_, isometric_areas_ * (1 + lambda_), how, report_);
    newton_->write_to(image_);
  }

  void go_equal_area() {
    const std::vector<ImagePoint> start = image_;
    if (!climb(swift) && !climb_slowly(start)) even_out(start);
  }

  bool climb_slowly(const std::vector<ImagePoint>& start) {
    const double error = error_of_areas(), lambda = lambda_, energy = report_.energy_after;
    const std::vector<ImagePoint> swiftly = std::exchange(image_, start);
    RestTriangles swift_aim = std::exchange(aim_, {});
    lambda_ = options_.from_lambda;
    lay_out(source_);
    if (climb(slow)) return true;
    if (error_of_areas() > error) {
      image_ = swiftly;
      aim_ = std::move(swift_aim);
      lambda_ = lambda;
      report_.energy_after = energy;
    }
    return false;
  }

  /// By areas alone, where a few triangles are so large that determinants do not tell theirs.
  void even_out(const std::vector<ImagePoint>& start) {
    const int threads = options_.optimise.threads;
    if (topology_.vertex_count() > most_evened_out) return;
    if (!(determinant_error(topology_, source_, image_, threads) > coarse_areas)) return;
    const double error = error_of_areas();
    const EvenedMap even = even_areas(topology_, source_, map_of(start),
                                      {.area_error = options_.area_error,
                                       .pinned = options_.optimise.pinned,
                                       .threads = threads,
                                       .progress = options_.optimise.progress});
    report_.steps += even.steps;
    std::vector<ImagePoint> climbed = std::exchange(image_, image_of(even.map));
    if (!(error_of_areas() < error)) {
      image_ = std::move(climbed);
      return;
    }
    lambda_ = greatest_lambda;
    aim_ = aimed_at_solid_angles(topology_, source_, image_, threads);
    lay_out(aim_);
    report_.energy_after = newton_->energy({.lambda = lambda_});
  }

  /// Up to the λ at which areas are equal. False: there is none, or none that is found.
  bool climb(const Climb& how) {
    double error = error_of_areas();
    do {
      while (error > options_.area_error && lambda_ < greatest_lambda) {
        aim_at_solid_angles();
        go(greatest_lambda, how);
        const double before = std::exchange(error, error_of_areas());
        const bool idle = !(error < (1 - idle_climb) * before);
        if (lambda_ > steep_lambda && idle) return error <= options_.area_error;
      }
      settle_climbed(how);  // which may raise the error a little
      error = error_of_areas();
    } while (error > options_.area_error && lambda_ < greatest_lambda);
    return error <= options_.area_error;
  }

  /// The more areas weigh, the less of the energy is more than an isometry has: the least gain is a
  /// greater share of that. Steps on the way may have ended by it.
  void settle_climbed(const Climb& how) {
    OptimiseOptions last = options_.optimise;
    last.least_gain *= std::sqrt(std::max(1.0, lambda_ / options_.from_lambda));
    if (!report_.converged || how.gain > last.least_gain) settle(last);
  }

  /// Where triangles are so large that it makes a difference.
  void aim_at_solid_angles() {
    const int threads = options_.optimise.threads;
    if (!(determinant_error(topology_, source_, image_, threads) > coarse_areas)) return;
    aim_ = aimed_at_solid_angles(topology_, source_, image_, threads);
    lay_out(aim_);
  }

  void go_conformal() {
    const double angles = newton_->energy({.lambda = 0}) - isometric_areas_;
    const double areas = newton_->energy({.lambda = 1}) - 2 * isometric_areas_ - angles;
    const double lambda = weight_of_areas * std::max(0.0, angles) / areas;
    lambda_ = std::isfinite(lambda) ? std::clamp(lambda, least_lambda, greatest_conformal_lambda)
                                    : least_lambda;
    settle(options_.optimise);
  }

  double error_of_areas() const {
    return area_error(topology_, source_, image_, options_.optimise.threads);
  }

  const Topology& topology_;
  const RestTriangles& source_;
  const BalanceOptions& options_;
  double lambda_;
  std::vector<ImagePoint> image_;
  RestTriangles aim_;           // of solid angles, where they make a difference
  double isometric_areas_ = 0;  // of what `newton_` aims at
  std::optional<GlobalNewton> newton_;
  OptimiseReport report_;
};

void require_domain(const BalanceOptions& options, int vertices) {
  require_domain(options.optimise, vertices);
  require_one_of("balance", options.balance, Balance::EqualArea);
  require_between("from_lambda", options.from_lambda, least_lambda, greatest_lambda);
  require_between("energy.lambda", options.optimise.energy.lambda, least_lambda, greatest_lambda);
  require_at_least("area_error", options.area_error, 0);
}

}  // namespace

BalancedMap optimise_balance(const Topology& topology, const RestTriangles& source,
                             const SphereMap& map, const BalanceOptions& options) {
  require_domain(options, topology.vertex_count());
  return Continuation(topology, source, map, options).run();
}

}  // namespace sphparam
