#include "embedding/constructions/kneading.h"

#include "embedding/energy/map_image.h"
#include "embedding/newton/global_newton.h"
#include "embedding/newton/minimise.h"

namespace sphparam {
namespace {

/// From λ to λ, so many times, and back again: beyond, areas are equal, or angles kept.
struct Way {
  double factor;
  int factors;
};
constexpr Way by_areas{10, 4}, by_angles{0.1, 3};
constexpr double rough = 1e-2;
constexpr int steps_there = 12, steps_back = 6;  // at each λ

}  // namespace

SphereMap knead(const Topology& topology, const RestTriangles& source, const SphereMap& map,
                Kneading kneading, const OptimiseOptions& how) {
  const Way& way = kneading == Kneading::ByAreas ? by_areas : by_angles;
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
  for (int k = 0; k < way.factors; ++k) {
    here.energy.lambda *= way.factor;
    settle(steps_there);
  }
  for (int k = 1; k < way.factors; ++k) {
    here.energy.lambda /= way.factor;
    settle(steps_back);
  }
  newton.write_to(image);
  return map_of(image);
}

}  // namespace sphparam
