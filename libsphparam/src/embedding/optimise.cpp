#include "sphparam/embedding/optimise.h"

#include <cmath>

#include "embedding/global_newton.h"

namespace sphparam {

Optimisation optimise(const Topology& topology, const SourceTriangles& source, const SphereMap& map,
                      const OptimiseOptions& options) {
  GlobalNewton newton(topology, source, map, options.pinned, options.threads);
  Optimisation result{map, {}};
  OptimiseReport& r = result.report;
  r.energy_before = r.energy_after = newton.energy(options.energy);
  if (!std::isfinite(r.energy_before)) return result;
  while (r.steps < options.max_steps && !r.converged) {
    const GlobalNewton::Step step = newton.step(options.energy, options.linear_tolerance);
    r.linear_iterations += step.iterations;
    r.converged = !(step.energy < (1 - options.least_gain) * r.energy_after);
    r.energy_after = step.energy;
    if (step.length == 0) break;
    ++r.steps;
    report(options.progress, "optimisation", static_cast<double>(r.steps) / options.max_steps);
  }
  result.map = newton.map();
  return result;
}

}  // namespace sphparam
