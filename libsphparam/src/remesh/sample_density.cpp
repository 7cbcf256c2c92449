#include "remesh/sample_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "elementary.h"
#include "embedding/energy/rest_areas.h"
#include "embedding/newton/optimise.h"
#include "option_domain.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/mesh/curvature.h"
#include "sphparam/remesh/adaptation.h"

// h = √(area / samples) is the grid's spacing where it is spread evenly. With κ averaged over h/2
// and at most 2/h,
//   density = e + (1 − e) κ^p / mean κ^p.
// H and K are averaged apart, so that H² < K may come out where κ₁ ≈ κ₂: (κ₁² + κ₂²)/2 = 2H² − K
// is then taken to be H², what it is at an umbilic.
// The map follows by Newton steps on its energy, each source triangle having its area times the
// density as the area to aim at.

namespace sphparam {
namespace {

constexpr double scale = 0.5;    // of the curvature, in spacings: a disk of them has about a cell
constexpr double most_bent = 2;  // times 1/spacing: a protrusion as thick as the spacing
constexpr double spread_evenly = 0.4;  // e: see the header
constexpr double exponent = 0.8;       // p: see the header
constexpr double least_gain = 1e-3;    // of a step: more does not lower the distance any more
constexpr char adapted_key[] = "adapted_for";  // in the provenance: so many vertices
constexpr int most_steps = 50;  // bad meshes creep; a map on its way is as good as any

/// The mesh at unit size: squares of what is finite neither overflow nor vanish.
TriangleMesh at_unit_size(const TriangleMesh& mesh) {
  const double size = mesh.positions.cwiseAbs().maxCoeff();
  if (!(size > 0)) return mesh;
  return {mesh.positions / size, mesh.triangles};
}

Eigen::ArrayXd bending(const Curvature& curvature) {
  const Eigen::ArrayXd squared = curvature.mean.array().square();
  return squared.max(2 * squared - curvature.gauss.array()).sqrt();
}

}  // namespace

VectorX sample_density(const TriangleMesh& mesh, const Topology& topology, std::int64_t samples,
                       int threads) {
  const TriangleMesh unit = at_unit_size(mesh);
  const double spacing = equal_area_radius(unit, threads) *
                         std::sqrt(4 * std::numbers::pi / static_cast<double>(samples));
  const Curvature curvature = measure_curvature(unit, topology, scale * spacing, threads);
  const VectorX bent = bending(curvature).min(most_bent / spacing).unaryExpr([](double x) {
    return elementary::pow(x, exponent);
  });
  const double mean = bent.dot(curvature.area) / curvature.area.sum();
  if (!(mean > 0) || !std::isfinite(mean)) return VectorX::Ones(bent.size());
  return spread_evenly + (1 - spread_evenly) / mean * bent.array();
}

Adaptation adapt_map(const MappedMesh& source, std::int64_t samples,
                     const AdaptationOptions& options) {
  require_at_least("samples", static_cast<double>(samples), 1);
  require_more_than("lambda", options.lambda, 0);
  require_between("lambda", options.lambda, 0, greatest_lambda);
  report(options.progress, "sample density", 0);
  const Topology& topology = source.topology();
  const VectorX density = sample_density(source.mesh(), topology, samples, options.threads);
  Optimisation relaxed = optimise(
      topology, with_density(topology, measure_source(source.mesh(), options.threads), density),
      source.map(),
      {.energy = {.lambda = options.lambda},
       .least_gain = least_gain,
       .max_steps = most_steps,
       .threads = options.threads,
       .progress = options.progress});
  Provenance lines = source.provenance();
  lines.emplace_back(adapted_key, std::to_string(samples));
  return {source.with_map(std::move(relaxed.map), std::move(lines)), relaxed.report.steps,
          density.minCoeff(), density.maxCoeff()};
}

bool is_adapted(const MappedMesh& mapped) {
  const Provenance& lines = mapped.provenance();
  return std::any_of(lines.begin(), lines.end(),
                     [](const auto& line) { return line.first == adapted_key; });
}

}  // namespace sphparam
