#include "embedding/constructions/float32_safe.h"

#include <utility>

#include "embedding/constructions/level_embedding.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/frame/landmarks.h"

namespace sphparam {
namespace {

// Of the mean, tried in turn; beyond 1 all triangles are alike, and the smallest weigh more. In a
// campaign the second held nearly all that rounding alone did not.
constexpr double shares[] = {1e-4, 1e-2, 1, 10, 100};

/// `from`, turned so that it is as near to `to` as can be.
SphereMap turned_like(const SphereMap& from, const SphereMap& to) {
  return normalised(from.points * best_rotation(from.points, to.points).transpose());
}

}  // namespace

Float32SafeRounding round_float32_safe(const TriangleMesh& mesh, const Topology& topology,
                                       const SphereMap& map, const Float32SafeOptions& options) {
  require_domain(options.energy);
  Float32SafeRounding result{round_to_float(topology, map, options.threads, options.radius)};
  if (result.rounding.certificate.bijective()) return result;
  if (!certify(topology, map, options.threads).bijective()) return result;
  for (const double share : shares) {
    // Newton steps on the finest level would take small triangles for what they are.
    constexpr double no_steps = 0;
    const ProgressiveEmbedding embedding = embed_by_levels(mesh, topology,
                                                           {.energy = options.energy,
                                                            .quality = Quality::Draft,
                                                            .least_area = share,
                                                            .threads = options.threads,
                                                            .progress = options.progress},
                                                           {}, {.demanding = no_steps});
    if (!embedding.map) continue;
    FloatRounding rounding =
        round_to_float(topology, turned_like(*embedding.map, map), options.threads, options.radius);
    if (rounding.certificate.bijective()) return {std::move(rounding), share};
  }
  return result;
}

}  // namespace sphparam
