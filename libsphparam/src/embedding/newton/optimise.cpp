#include "embedding/newton/optimise.h"

#include <algorithm>
#include <cmath>

#include "elementary.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/newton/global_newton.h"
#include "mesh/triangle_geometry.h"
#include "sphparam/parallel.h"

// A step: projected Newton (global_newton.cpp), then sweeps of guarded relaxation, which smooth
// what the step has creased and so lengthen the next one. Towards λ = 0 the Möbius transformations
// become nearly free; they are treated apart, by a step in three dimensions. Gains are measured on
// E − E(isometry): near a conformal map E itself is a large constant.

namespace sphparam {
namespace {

constexpr double loose_lambda = 0.01;  // below it Möbius transformations cost hardly any energy
constexpr double least_recentring = 0.01;  // of `least_gain`: not worth a second one
constexpr double on_the_way_gain = 1e-2;
constexpr int on_the_way_steps = 12;
constexpr double factor_down = 0.1, factor_up = 4;
constexpr double no_difference = 2e-3;  // of the mean angle error, by a factor of λ

/// A f of an isometry: what no map of small triangles gets below.
double isometric_energy(const RestTriangles& source, const DistortionEnergy& energy,
                        const FillerMarks& pressed) {
  double area = 0, of_pressed = 0;
  for (const RestTriangle& triangle : source) area += triangle.area;
  for (size_t f = 0; f < pressed.size(); ++f) of_pressed += pressed[f] ? source[f].area : 0;
  return energy.pressure * of_pressed +
         area * (energy.kind == EnergyKind::SymmetricDirichlet ? 2 : 1 + energy.lambda);
}

ImageTriangle triangle_of(const Topology& topology, const std::vector<ImagePoint>& image, Face f) {
  const auto corner = [&](int k) {
    return image[static_cast<size_t>(topology.vertex(f, k))].vector();
  };
  return {corner(0), corner(1), corner(2)};
}

/// Mean |log2 (|Ω| / A)|, weighted by A. |Ω| = 2 atan2(det(a, b, c), 1 + a·b + b·c + c·a)
double area_error(const Topology& topology, const RestTriangles& source,
                  const std::vector<ImagePoint>& image, int threads) {
  double area = 0;
  for (const RestTriangle& triangle : source) area += triangle.area;
  const auto chunk = [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (Face f = static_cast<Face>(first); f < static_cast<Face>(last); ++f) {
      const auto [a, b, c] = triangle_of(topology, image, f);
      const double det = a.dot((b - a).cross(c - a));
      const double angle = 2 * elementary::atan2(det, 1 + a.dot(b) + b.dot(c) + c.dot(a));
      const double source_area = source[static_cast<size_t>(f)].area;
      sum += source_area * std::abs(elementary::log2(angle / source_area));
    }
    return sum;
  };
  return parallel_sum(topology.face_count(), threads, chunk) / area;
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

std::vector<ImagePoint> image_of(const SphereMap& map) {
  std::vector<ImagePoint> image(static_cast<size_t>(map.points.rows()));
  for (size_t v = 0; v < image.size(); ++v) {
    image[v] = image_point(map.point(static_cast<Vertex>(v)));
  }
  return image;
}

SphereMap map_of(const std::vector<ImagePoint>& image) {
  SphereMap map;
  map.points.resize(static_cast<Eigen::Index>(image.size()), 3);
  for (size_t v = 0; v < image.size(); ++v) {
    map.points.row(static_cast<Vertex>(v)) = image[v].vector();
  }
  return map;
}

/// Steps until converged; adds to the report's counts.
void minimise(GlobalNewton& newton, double isometric, const OptimiseOptions& options,
              OptimiseReport& r) {
  double done = 0;
  newton.ask_with([&] { report(options.progress, "optimisation", done); });
  r.converged = false;
  r.energy_before = r.energy_after = newton.energy(options.energy);
  if (!std::isfinite(r.energy_before) || !newton.can_move()) return;
  bool recentring = options.energy.kind == EnergyKind::AngleAndArea &&
                    options.energy.lambda < loose_lambda && options.pinned.empty();
  for (int n = 0; n < options.max_steps && !r.converged; ++n) {
    const GlobalNewton::Step step = newton.step(options.energy, options.least_share);
    newton.sweep(options.energy, options.sweeps);
    double after = newton.energy(options.energy);
    if (recentring) {
      const double centred = newton.recentre(options.energy);
      recentring = after - centred > least_recentring * options.least_gain * (centred - isometric);
      after = centred;
    }
    r.linear_iterations += step.iterations;
    r.converged = !(r.energy_after - after > options.least_gain * (after - isometric));
    r.energy_after = std::min(r.energy_after, after);
    ++r.steps;
    done = static_cast<double>(n + 1) / options.max_steps;
    report(options.progress, "optimisation", done);
  }
}

void require_domain(const OptimiseOptions& options, int vertices) {
  require_domain(options.energy);
  require_between("least_gain", options.least_gain, 0, 1);
  require_at_least("max_steps", options.max_steps, 0);
  require_between("least_share", options.least_share, 0, 1);
  require_at_least("sweeps", options.sweeps, 0);
  require_vertices("pinned", options.pinned, vertices);
}

}  // namespace

Optimisation optimise(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                      const OptimiseOptions& options) {
  require_domain(options, topology.vertex_count());
  std::vector<ImagePoint> image = image_of(map);
  GlobalNewton newton(topology, source, image, options.pinned, options.threads, options.pressed);
  Optimisation result;
  minimise(newton, isometric_energy(source, options.energy, options.pressed), options,
           result.report);
  newton.write_to(image);
  result.map = map_of(image);
  return result;
}

namespace {

/// Takes a map from λ to λ.
class Continuation {
 public:
  Continuation(const Topology& topology, const RestTriangles& source, const SphereMap& map,
               const BalanceOptions& options)
      : topology_(topology),
        source_(source),
        options_(options),
        lambda_(options.from_lambda),
        image_(image_of(map)),
        newton_(topology, source, image_, options.optimise.pinned, options.optimise.threads) {}

  BalancedMap run() {
    switch (options_.balance) {
      case Balance::Lambda:
        while (lambda_ != options_.optimise.energy.lambda) go(options_.optimise.energy.lambda);
        settle(options_.optimise);
        break;
      case Balance::EqualArea:
        do {
          while (error_of_areas() > options_.area_error && lambda_ < greatest_lambda) {
            go(greatest_lambda);
          }
          settle(options_.optimise);  // which may raise the error a little
        } while (error_of_areas() > options_.area_error && lambda_ < greatest_lambda);
        break;
      case Balance::Conformal:
        go_conformal();
        break;
    }
    return {map_of(image_), lambda_, error_of_areas(), report_};
  }

 private:
  /// One factor of λ towards the aim.
  void go(double aim) {
    lambda_ =
        aim < lambda_ ? std::max(aim, lambda_ * factor_down) : std::min(aim, lambda_ * factor_up);
    OptimiseOptions rough = options_.optimise;
    rough.least_gain = std::max(rough.least_gain, on_the_way_gain);
    rough.max_steps = std::min(rough.max_steps, on_the_way_steps);
    settle(rough);
  }

  void settle(OptimiseOptions how) {
    how.energy.lambda = lambda_;
    minimise(newton_, isometric_energy(source_, how.energy, {}), how, report_);
    newton_.write_to(image_);
  }

  /// As long as the mean angle error falls. (It need not, in the end: the energy weighs triangles
  /// by their area, and so few large ones of the image against many small ones.)
  void go_conformal() {
    double error = error_of_angles();
    while (lambda_ > least_lambda) {
      const double lambda_before = lambda_;
      const std::vector<ImagePoint> before = image_;
      go(least_lambda);
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
  GlobalNewton newton_;
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
