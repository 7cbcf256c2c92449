#include "embedding/newton/optimise.h"

#include <algorithm>
#include <cmath>

#include "embedding/energy/energy_domain.h"
#include "embedding/energy/map_image.h"
#include "embedding/newton/global_newton.h"
#include "embedding/newton/minimise.h"

// A step: projected Newton (global_newton.cpp), then sweeps of guarded relaxation, which smooth
// what the step has creased and so lengthen the next one. Towards λ = 0 the Möbius transformations
// become nearly free; they are treated apart, by a step in three dimensions. Gains are measured on
// E − E(isometry): near a conformal map E itself is a large constant.

namespace sphparam {
namespace {

constexpr double loose_lambda = 0.01;  // below it Möbius transformations cost hardly any energy
constexpr double least_recentring = 0.01;  // of `least_gain`: not worth a second one

}  // namespace

double isometric_energy(const RestTriangles& source, const DistortionEnergy& energy,
                        const FillerMarks& pressed) {
  double area = 0, of_pressed = 0;
  for (const RestTriangle& triangle : source) area += triangle.area;
  for (size_t f = 0; f < pressed.size(); ++f) of_pressed += pressed[f] ? source[f].area : 0;
  return energy.pressure * of_pressed +
         area * (energy.kind == EnergyKind::SymmetricDirichlet ? 2 : 1 + energy.lambda);
}

void minimise(GlobalNewton& newton, double isometric, const OptimiseOptions& options,
              OptimiseReport& r) {
  double done = 0;
  newton.ask_with([&] { report(options.progress, "optimisation", done); });
  r.converged = false;
  r.energy_before = r.energy_after = newton.energy(options.energy);
  if (!std::isfinite(r.energy_before) || !newton.can_move() || !newton.covers_once()) return;
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

Optimisation optimise(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                      const OptimiseOptions& options) {
  require_domain(options, topology.vertex_count());
  std::vector<ImagePoint> image = image_of(map);
  const FillerMarks none;
  GlobalNewton newton(topology, source, image, options.pinned, options.threads,
                      options.energy.pressure != 0 ? options.pressed : none);
  Optimisation result;
  minimise(newton, isometric_energy(source, options.energy, options.pressed), options,
           result.report);
  newton.write_to(image);
  result.map = map_of(image);
  return result;
}

}  // namespace sphparam
