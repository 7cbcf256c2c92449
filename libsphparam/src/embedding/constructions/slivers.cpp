#include "embedding/constructions/slivers.h"

#include <algorithm>

namespace sphparam {
namespace {

constexpr double slimming = 0.3;
constexpr double slim = 1.02;      // times the area: where no triangle has more, all are slim
constexpr double slimmest = 1e-6;  // of what is thinner doubles know little

}  // namespace

SphereMap slim_down(const Topology& topology, const RestTriangles& source, SphereMap map,
                    const OptimiseOptions& how) {
  for (double mu = fattening * slimming; mu > slimmest; mu *= slimming) {
    const RestTriangles fat = fattened(source, mu, how.threads);
    const bool is_slim = std::ranges::equal(
        fat, source, [](const auto& a, const auto& b) { return a.area < slim * b.area; });
    if (is_slim) break;
    map = optimise(topology, fat, map, how).map;
  }
  return map;
}

}  // namespace sphparam
