#include "trial.h"

#include <ctime>
#include <exception>

#include "digest.h"
#include "embedding/constructions/float32_safe.h"
#include "sphparam/parameterize.h"

namespace sphparam::campaign {
namespace {

std::uint64_t hash_of(const Points& points) {
  Digest digest;
  digest.add(points);
  return digest.bits();
}

}  // namespace

Outcome try_specimen(const Specimen& specimen, bool compare_threads) {
  Outcome outcome;
  outcome.family = specimen.family;
  outcome.faces = specimen.mesh.face_count();
  try {
    const std::clock_t begun = std::clock();
    const Parameterization result = parameterize(specimen.mesh, {.threads = 1});
    outcome.seconds = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
    outcome.made_by = result.made_by;
    const Topology topology(specimen.mesh);
    outcome.certified = result.map.points.rows() == topology.vertex_count() &&
                        certify(topology, result.map, 1).bijective();
    outcome.hash = hash_of(result.map.points);
    if (outcome.certified) {
      outcome.float32_folds =
          round_float32_safe(specimen.mesh, topology, result.map, {.threads = 1})
              .rounding.bad_after;
    }
    if (!compare_threads) return outcome;
    for (const int threads : {2, 4}) {
      const Points again = parameterize(specimen.mesh, {.threads = threads}).map.points;
      outcome.thread_dependent = outcome.thread_dependent || hash_of(again) != outcome.hash;
    }
  } catch (const std::exception& error) {
    outcome.error = error.what();
  }
  return outcome;
}

}  // namespace sphparam::campaign
