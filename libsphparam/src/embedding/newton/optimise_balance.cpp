#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "elementary.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/energy/map_image.h"
#include "embedding/energy/solid_angle_aim.h"
#include "embedding/newton/global_newton.h"
#include "embedding/newton/minimise.h"
#include "embedding/newton/optimise.h"
#include "mesh/triangle_geometry.h"
#include "sphparam/parallel.h"

// From λ to λ, each time from the map before. Equal areas are areas of spherical triangles, where
// the energy has determinants: where triangles are large its areas are corrected on the way. Where
// a swift climb ends without equal areas, a slow one from the same start often does not: areas that
// are to travel along a rod need many steps at each λ.

namespace sphparam {
namespace {

constexpr double factor_down = 0.1;
constexpr double no_difference = 2e-3;  // of the mean angle error, by a factor of λ
constexpr double coarse_areas = 5e-3;   // mean |log2| of a determinant over twice a solid angle
constexpr double steep_lambda = 1e4;    // beyond it a factor of λ that changes no area is the last
constexpr double idle_climb = 0.01;     // of the area error

/// How one factor of λ is made.
struct Climb {
  double factor, gain;
  int steps;
};
constexpr Climb swift{4, 1e-2, 12}, slow{2, 1e-3, 60};

ImageTriangle triangle_of(const Topology& topology, const std::vector<ImagePoint>& image, Face f) {
  const auto corner = [&](int k) {
    return image[static_cast<size_t>(topology.vertex(f, k))].vector();
  };
  return {corner(0), corner(1), corner(2)};
}

/// The angle at `corner` of a triangle.
double angle_at(const ImageTriangle& x, size_t corner) {
  const Vector3 a = x[(corner + 1) % 3] - x[corner], b = x[(corner + 2) % 3] - x[corner];
  return angle_between(a, b);
}

/// Mean |ln (angle of the chord triangle / angle of the source)| over all corners.
double angle_error(const Topology& topology, const RestTriangles& source,
                   const std::vector<ImagePoint>& image, int threads) {
  const auto chunk = [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (Face f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
      const RestTriangle& s = source[static_cast<size_t>(f)];
      const double base = 1 / s.inverse_base;
      const ImageTriangle before{Vector3::Zero(), Vector3(base, 0, 0),
                                 Vector3(s.foot * base, 1 / s.inverse_height, 0)};
      const ImageTriangle after = triangle_of(topology, image, f);
      for (size_t k = 0; k < 3; ++k) {
        sum += std::abs(elementary::log(angle_at(after, k) / angle_at(before, k)));
      }
    }
    return sum;
  };
  return parallel_sum(topology.face_count(), threads, chunk) / (3.0 * topology.face_count());
}

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
    return {map_of(image_), lambda_, error_of_areas(), report_};
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
    if (climb(swift)) return;
    const double error = error_of_areas(), lambda = lambda_, energy = report_.energy_after;
    const std::vector<ImagePoint> swiftly = std::exchange(image_, start);
    lambda_ = options_.from_lambda;
    lay_out(source_);
    if (climb(slow) || !(error_of_areas() > error)) return;
    image_ = swiftly;
    lambda_ = lambda;
    report_.energy_after = energy;
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
      settle(options_.optimise);  // which may raise the error a little
      error = error_of_areas();
    } while (error > options_.area_error && lambda_ < greatest_lambda);
    return error <= options_.area_error;
  }

  /// Where triangles are so large that it makes a difference.
  void aim_at_solid_angles() {
    const int threads = options_.optimise.threads;
    if (!(determinant_error(topology_, source_, image_, threads) > coarse_areas)) return;
    lay_out(aimed_at_solid_angles(topology_, source_, image_, threads));
  }

  /// As long as the mean angle error falls. (It need not, in the end: the energy weighs triangles
  /// by their area, and so few large ones of the image against many small ones.)
  void go_conformal() {
    double error = error_of_angles();
    while (lambda_ > least_lambda) {
      const double lambda_before = lambda_;
      const std::vector<ImagePoint> before = image_;
      go(least_lambda, swift);
      const double now = error_of_angles();
      if (now > error) {
        image_ = before;
        lambda_ = lambda_before;
      }
      if (!(now < (1 - no_difference) * error)) return;
      error = now;
    }
  }

  double error_of_areas() const {
    return area_error(topology_, source_, image_, options_.optimise.threads);
  }
  double error_of_angles() const {
    return angle_error(topology_, source_, image_, options_.optimise.threads);
  }

  const Topology& topology_;
  const RestTriangles& source_;
  const BalanceOptions& options_;
  double lambda_;
  std::vector<ImagePoint> image_;
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
