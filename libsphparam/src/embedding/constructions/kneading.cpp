#include "embedding/constructions/kneading.h"

#include "embedding/energy/map_image.h"
#include "embedding/newton/global_newton.h"
#include "embedding/newton/minimise.h"

namespace sphparam {
namespace {

constexpr double factor = 10;  // from λ to λ
constexpr int factors = 4;     // up, and down again: beyond, areas are equal
constexpr double rough = 1e-2;
constexpr int steps_up = 12, steps_down = 6;  // at each

}  // namespace

SphereMap knead(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                const OptimiseOptions& how) {
  std::vector<ImagePoint> image = image_of(map);
  GlobalNewton newton(topology, source, image, how.pinned, how.threads);
  const double isometric_areas = isometric_energy(source, {.lambda = 0}, {});
  OptimiseOptions here = how;
  here.least_gain = rough;
  OptimiseReport report;
  const auto settle = [&](int steps) {
    here.max_steps = steps;
    minimise(newton, isometric_areas * (1 + here.energy.lambda), here, report);
  };
  for (int k = 0; k < factors; ++k) {
    here.energy.lambda *= factor;
    settle(steps_up);
  }
  for (int k = 1; k < factors; ++k) {
    here.energy.lambda /= factor;
    settle(steps_down);
  }
  newton.write_to(image);
  return map_of(image);
}

}  // namespace sphparam
