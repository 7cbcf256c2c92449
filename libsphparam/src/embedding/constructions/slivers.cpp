#include "embedding/constructions/slivers.h"

#include <cstddef>

namespace sphparam {
namespace {

constexpr double slimming = 0.3;
constexpr double slim = 1.02;      // times the area: where no triangle has more, all are slim
constexpr double slimmest = 1e-6;  // of what is thinner doubles know little

bool are_slim(const RestTriangles& fat, const RestTriangles& source) {
  for (size_t f = 0; f < source.size(); ++f) {
    if (!(fat[f].area < slim * source[f].area)) return false;
  }
  return true;
}

}  // namespace

SphereMap slim_down(const Topology& topology, const RestTriangles& source, SphereMap map,
                    const OptimiseOptions& how) {
  for (double mu = fattening * slimming; mu > slimmest; mu *= slimming) {
    const RestTriangles fat = fattened(source, mu, how.threads);
    if (are_slim(fat, source)) break;
    map = optimise(topology, fat, map, how).map;
  }
  return map;
}

}  // namespace sphparam
