#include "embedding/constructions/progressive.h"

#include <algorithm>

#include "embedding/constructions/starts.h"
#include "embedding/energy/energy_domain.h"
#include "embedding/frame/pin_domain.h"
#include "embedding/newton/freed_memory.h"
#include "embedding/sweeps/relaxation.h"

// Of several starts the lowest map is taken (starts.cpp). Where none finds room the shape is
// forgotten, and everything counts as equilateral.

namespace sphparam {
namespace {

constexpr int shape_sweeps = 30;  // of relaxation, where the embedding knew nothing of the shape

/// As if all triangles were equilateral, then relaxed and refined for the shape they have. No
/// shape is too hard for that, but what neither reaches stays distorted.
ProgressiveEmbedding embed_by_valences(const TriangleMesh& mesh, const Topology& topology,
                                       const ProgressiveOptions& options,
                                       const KeptVertices& keep) {
  TriangleMesh shapeless = mesh;
  shapeless.positions.setZero();
  ProgressiveOptions draft = options;
  draft.quality = Quality::Draft;
  draft.least_area = 1;  // all are as large as the mean: the source has the sphere's area
  ProgressiveEmbedding embedding = Starts(shapeless, topology, draft, keep).first();
  if (!embedding.map) return embedding;
  embedding.map = relax(topology, measure_source(mesh, options.threads), *embedding.map,
                        {.energy = options.energy,
                         .sweeps = shape_sweeps,
                         .pinned = keep.vertices,
                         .threads = options.threads,
                         .progress = options.progress,
                         .measure_energy = false})
                      .map;
  const Starts starts(mesh, topology, options, keep);
  starts.refine(embedding, starts.steps(options.energy, options.quality));
  return embedding;
}

void require_domain(const ProgressiveOptions& options, int vertices) {
  require_domain(options.energy);
  require_one_of("quality", options.quality, Quality::Best);
  require_at_least("sweeps", options.sweeps, 0);
  require_at_least("most_sweeps", options.most_sweeps, 0);
  require_between("over_relaxation", options.over_relaxation, 0, most_over_relaxation);
  require_between("retries", options.retries, 0, most_retries);
  require_at_least("pin_level", options.pin_level, 0);
  require_between("least_area", options.least_area, 0, 1);
  require_between("filler_share", options.filler_share, 0, 1);
  require_pins(options.pins, vertices);
}

}  // namespace

ProgressiveEmbedding embed_progressively(const TriangleMesh& mesh, const Topology& topology,
                                         const ProgressiveOptions& options) {
  require_domain(options, topology.vertex_count());
  report(options.progress, "hierarchy", 0);
  KeptVertices keep{{}, std::max(options.pin_level, 20 * static_cast<int>(options.pins.size()))};
  for (const Pin& pin : options.pins) keep.vertices.push_back(pin.vertex);
  ProgressiveEmbedding embedding = Starts(mesh, topology, options, keep).lowest();
  if (embedding.map && !options.pins.empty())
    embedding.report.pin_residuals = pin_residuals(*embedding.map, options.pins);
  give_back_freed_memory();  // before the caller measures and turns the map
  if (embedding.map) return embedding;
  const int retries = embedding.report.retries;
  embedding = embed_by_valences(mesh, topology, options, keep);
  embedding.report.retries += retries;
  return embedding;
}

}  // namespace sphparam
