#include "sphparam/embedding/optimise.h"

#include <algorithm>
#include <cmath>

#include "embedding/global_newton.h"

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
constexpr double least_lambda = 1e-10, greatest_lambda = 1e6;
constexpr double no_difference = 1e-3;  // by a factor of λ, in E − E(isometry)

/// A f of an isometry: what no map of small triangles gets below.
double isometric_energy(const SourceTriangles& source, const DistortionEnergy& energy) {
  double area = 0;
  for (const SourceTriangle& triangle : source) area += triangle.area;
  return area * (energy.kind == EnergyKind::SymmetricDirichlet ? 2 : 1 + energy.lambda);
}

/// Mean |log2 (|Ω| / A)|, weighted by A. |Ω| = 2 atan2(det(a, b, c), 1 + a·b + b·c + c·a)
double area_error(const Topology& topology, const SourceTriangles& source,
                  const std::vector<ImagePoint>& image) {
  double sum = 0, area = 0;
  for (Face f = 0; f < topology.face_count(); ++f) {
    const auto corner = [&](int k) {
      return image[static_cast<size_t>(topology.vertex(f, k))].vector();
    };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    const double det = a.dot((b - a).cross(c - a));
    const double angle = 2 * std::atan2(det, 1 + a.dot(b) + b.dot(c) + c.dot(a));
    const double source_area = source[static_cast<size_t>(f)].area;
    sum += source_area * std::abs(std::log2(angle / source_area));
    area += source_area;
  }
  return sum / area;
}

std::vector<ImagePoint> image_of(const SphereMap& map) {
  std::vector<ImagePoint> image(static_cast<size_t>(map.points.rows()));
  for (size_t v = 0; v < image.size(); ++v) {
    image[v] = image_point(map.point(static_cast<Vertex>(v)));
  }
  return image;
}

SphereMap map_of(const GlobalNewton& newton, std::vector<ImagePoint>& image) {
  newton.write_to(image);
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
  r.converged = false;
  r.energy_before = r.energy_after = newton.energy(options.energy);
  if (!std::isfinite(r.energy_before)) return;
  bool recentring = options.energy.kind == EnergyKind::AngleAndArea &&
                    options.energy.lambda < loose_lambda && options.pinned.empty();
  for (int n = 0; n < options.max_steps && !r.converged; ++n) {
    const GlobalNewton::Step step = newton.step(options.energy, options.linear_tolerance);
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
    report(options.progress, "optimisation", static_cast<double>(n + 1) / options.max_steps);
  }
}

}  // namespace

Optimisation optimise(const Topology& topology, const SourceTriangles& source, const SphereMap& map,
                      const OptimiseOptions& options) {
  std::vector<ImagePoint> image = image_of(map);
  GlobalNewton newton(topology, source, image, options.pinned, options.threads);
  Optimisation result;
  minimise(newton, isometric_energy(source, options.energy), options, result.report);
  result.map = map_of(newton, image);
  return result;
}

BalancedMap optimise_balance(const Topology& topology, const SourceTriangles& source,
                             const SphereMap& map, const BalanceOptions& options) {
  std::vector<ImagePoint> image = image_of(map);
  GlobalNewton newton(topology, source, image, options.optimise.pinned, options.optimise.threads);
  const bool given = options.balance == Balance::Lambda;
  const double aim = given                                   ? options.optimise.energy.lambda
                     : options.balance == Balance::Conformal ? least_lambda
                                                             : greatest_lambda;
  BalancedMap result{{}, options.from_lambda, area_error(topology, source, image), {}};
  OptimiseOptions rough = options.optimise;
  rough.least_gain = std::max(rough.least_gain, on_the_way_gain);
  rough.max_steps = std::min(rough.max_steps, on_the_way_steps);
  const auto minimise_for = [&](const OptimiseOptions& how) {
    OptimiseOptions now = how;
    now.energy.lambda = result.lambda;
    const double isometric = isometric_energy(source, now.energy);
    minimise(newton, isometric, now, result.report);
    return (result.report.energy_before - result.report.energy_after) /
           (result.report.energy_after - isometric);
  };
  const bool equal_area = options.balance == Balance::EqualArea;
  while (result.lambda != aim && !(equal_area && result.area_error <= options.area_error)) {
    const bool down = aim < result.lambda;
    const double next = result.lambda * (down ? factor_down : factor_up);
    result.lambda = down ? std::max(aim, next) : std::min(aim, next);
    const double gain = minimise_for(rough);
    newton.write_to(image);
    result.area_error = area_error(topology, source, image);
    if (options.balance == Balance::Conformal && gain < no_difference) break;
  }
  minimise_for(options.optimise);
  result.map = map_of(newton, image);
  result.area_error = area_error(topology, source, image);
  return result;
}

}  // namespace sphparam
