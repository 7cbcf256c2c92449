#include "pipeline/repair_ladder.h"

#include <utility>

#include "embedding/constructions/gnomonic.h"
#include "embedding/constructions/grid_lift.h"
#include "embedding/constructions/untangle.h"
#include "pipeline/alignment.h"
#include "pipeline/balanced_embedding.h"
#include "pipeline/radial_map.h"
#include "sphparam/errors.h"
#include "sphparam/sphere/certificate.h"

// The rungs, from the one that keeps most of the map to the one that always has room: untangling
// where folds are few, the progressive embedding, the one-vertex lift, the grid lift.

namespace sphparam {
namespace {

constexpr double most_folds = 0.02;        // of the faces: beyond it nothing is local any more
constexpr double most_radial_folds = 0.2;  // where what lies right is worth more work

/// Of a radial map, which has the surface where it should be.
bool only_fillers_fold(const MapInProgress& work) {
  return work.result.radial && work.result.radial->folds == 0;
}

void untangle_folds(MapInProgress& work) {
  if (work.result.map.points.rows() == 0) return;  // the method made no map
  UntangleOptions untangling{.lambda = work.options.energy.lambda,
                             .threads = work.options.threads,
                             .progress = work.options.progress};
  if (work.result.poles) untangling.pinned = {work.result.poles->north, work.result.poles->south};
  if (only_fillers_fold(work)) {  // however many, they give way where there is room among them
    UntangleOptions of_fillers = untangling;
    of_fillers.pinned = surface_vertices(work);
    SphereMap map = untangle(work.topology, work.source(), work.result.map, of_fillers).map;
    if (certify(work.topology, map, work.options.threads).bijective()) {
      work.record("untangling", map);
      return work.accept("untangling", std::move(map));
    }
  }
  const double most = work.options.method == Method::Radial ? most_radial_folds : most_folds;
  if (static_cast<double>(work.result.certificate.fold_count()) > most * work.topology.face_count())
    return;
  SphereMap map = untangle(work.topology, work.source(), work.result.map, untangling).map;
  work.record("untangling", map);
  work.accept("untangling", std::move(map));
}

void embed_from_nothing(MapInProgress& work) {
  if (work.tried_to_embed || !embed(work, {})) return;
  work.forget_poles();
}

void lift_one_vertex(MapInProgress& work) {
  GnomonicEmbedding embedding;
  try {
    embedding = gnomonic_embedding(work.mesh, work.topology,
                                   {.lambda = work.options.energy.lambda,
                                    .threads = work.options.threads,
                                    .progress = work.options.progress});
  } catch (const SolveError& error) {  // protrusions where doubles underflow
    return work.warn(error.what());
  }
  work.forget_poles();
  work.record("one-vertex lift", embedding.map);
  work.accept("one-vertex lift", std::move(embedding.map));
}

void lift_grid(MapInProgress& work) {
  GridLift lift = grid_lift(work.mesh, work.topology,
                            {.energy = {.lambda = work.options.energy.lambda},
                             .threads = work.options.threads,
                             .progress = work.options.progress});
  if (!lift.bijective) return work.warn("the grid lift found no room");
  work.forget_poles();
  work.warn("made by the last resort, the grid lift: one-to-one, but greatly distorted");
  work.record("grid lift", lift.map);
  work.accept("grid lift", std::move(lift.map));
}

}  // namespace

void repair(MapInProgress& work) {
  if (!work.certified()) untangle_folds(work);
  if (work.certified()) return;
  const bool replaces = work.result.map.points.rows() > 0 && !work.tried_to_embed;
  embed_from_nothing(work);
  if (!work.certified()) lift_one_vertex(work);
  if (!work.certified()) lift_grid(work);
  if (work.certified()) keep_orientation(work);
  work.result.made_anew = work.certified() && replaces;
  if (work.result.made_anew)
    work.warn(
        "nothing is left of the map that was to be mended, which has too many folds or could "
        "not be untangled: another was made (" +
        work.result.made_by + ")");
}

}  // namespace sphparam
