#include "support/reference_newton.h"

#include <numeric>

#include "embedding/energy/energy_domain.h"
#include "embedding/newton/newton_patch.h"
#include "embedding/sweeps/free_vertices.h"

namespace sphparam {
namespace {

void require_domain(const NewtonOptions& options, int vertices) {
  require_domain(options.energy);
  require_at_least("max_steps", options.max_steps, 0);
  require_between("least_gain", options.least_gain, 0, 1);
  if (options.vertices) require_vertices("vertices", *options.vertices, vertices);
  require_vertices("pinned", options.pinned, vertices);
}

}  // namespace

NewtonResult minimise_by_newton(const Topology& topology, const RestTriangles& source,
                                const SphereMap& map, const NewtonOptions& options) {
  require_domain(options, topology.vertex_count());
  NewtonPatch patch(topology, source, map.points,
                    free_vertices(topology.vertex_count(), options.vertices, options.pinned));
  NewtonResult result{map, {}};
  NewtonReport& report = result.report;
  report.energy_before = report.energy_after = patch.energy(options.energy);
  if (patch.free_count() == 0) return result;
  const bool guarded = !(options.energy.epsilon > 0);
  if (!std::isfinite(report.energy_before) || (guarded && patch.folds() > 0)) return result;
  while (report.steps < options.max_steps && !report.converged) {
    const NewtonPatch::Step step = patch.step(options.energy);
    const double gain = report.energy_after - step.energy;
    report.converged = !step.moved || gain < options.least_gain * report.energy_after;
    report.energy_after = step.energy;
    ++report.steps;
    sphparam::report(options.progress, "newton",
                     static_cast<double>(report.steps) / options.max_steps);
  }
  patch.write_to(result.map.points);
  return result;
}

}  // namespace sphparam
