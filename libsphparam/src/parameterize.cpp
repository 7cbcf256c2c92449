#include "sphparam/parameterize.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "curvilinear/curvilinear_map.h"
#include "curvilinear/paper_map.h"
#include "embedding/frame/landmarks.h"
#include "embedding/newton/freed_memory.h"
#include "embedding/sweeps/relaxation.h"
#include "mesh/rings.h"
#include "number_text.h"
#include "pipeline/alignment.h"
#include "pipeline/balanced_embedding.h"
#include "pipeline/frame.h"
#include "pipeline/map_in_progress.h"
#include "pipeline/radial_map.h"
#include "pipeline/repair_ladder.h"
#include "pipeline/required_options.h"
#include "sphparam/mesh/mesh_defects.h"

// The table of contents. Four methods, each a straight line of stages:
//   paper        poles → date line, cut, harmonic, quasi-harmonic, lift, smoothing
//   curvilinear  poles → the same, periodic and accumulated → relaxation along the date line
//   progressive  hierarchy, embedding
//   radial       directions from a centre
// Then the certificate; where it fails and repair is wanted, the repair ladder: untangling, the
// progressive embedding, the one-vertex lift, the grid lift. A certified map gets its frame last:
// poles, pins, meridian, or the directions that it is aligned to. Whatever comes out last is
// certified as it is.

namespace sphparam {
namespace {

constexpr int date_line_rings = 5;    // the paper's five-neighbourhood (Section 5)
constexpr int date_line_sweeps = 10;  // of guarded relaxation there

void warn_if_moved(MapInProgress& work, const char* pole, Vertex wanted, Vertex used) {
  if (wanted == used) return;
  work.warn(std::string(pole) + " pole moved from vertex " + std::to_string(wanted) + " to " +
            std::to_string(used) + ": the wanted pair is too close, or its links have chords");
}

std::optional<Poles> find_poles(MapInProgress& work) {
  report(work.options.progress, "poles", 0);
  std::optional<Poles> poles = work.options.poles
                                   ? nearest_usable_poles(work.topology, *work.options.poles)
                                   : choose_poles(work.mesh, work.topology);
  if (poles && work.options.poles) {
    warn_if_moved(work, "north", work.options.poles->north, poles->north);
    warn_if_moved(work, "south", work.options.poles->south, poles->south);
  }
  work.result.stages.push_back({"poles", work.lap()});
  return poles;
}

void map_paper(MapInProgress& work) {
  const std::optional<Poles> poles = find_poles(work);
  if (!poles) return work.warn("no usable pair of poles: the paper's method does not apply");
  const PaperSettings& s = work.options.paper;
  const PaperOptions paper{s.epsilon, s.iterations, s.rings,
                           s.sweeps,  s.weights,    work.options.threads};
  const auto on_stage = [&work](const PaperStage& stage, const SphereMap& map) {
    work.result.stages.push_back(
        {stage.name, stage.seconds, stage.planar_folds, work.count_folds(map), work.measured(map)});
  };
  PaperResult paper_map;
  try {
    paper_map =
        map_as_paper(work.mesh, work.topology, *poles, paper, work.options.progress, on_stage);
  } catch (const SolveError& error) {  // as below
    return work.warn(error.what());
  }
  work.result.stages.insert(work.result.stages.end() - static_cast<long>(paper_map.stages.size()),
                            {"date line", paper_map.path_seconds});
  work.result.poles = poles;
  work.result.date_line = std::move(paper_map.date_line);
  work.lap();
  work.accept("smoothing", std::move(paper_map.map));
}

/// Its smoothing takes them with it.
void warn_of_poles_of_paper(MapInProgress& work) {
  if (!work.options.poles || !work.result.poles) return;
  const auto [north, south] = *work.result.poles;
  const std::vector<double> residuals =
      pin_residuals(work.result.map, {{north, Vector3::UnitZ()}, {south, -Vector3::UnitZ()}});
  if (all_exact(residuals)) return;
  work.warn("the paper's smoothing has moved the poles: they are " + short_number(residuals[0]) +
            " and " + short_number(residuals[1]) +
            " radians from ±z; without sweeps of it they stay there");
}

void map_curvilinear(MapInProgress& work) {
  const std::optional<Poles> poles = find_poles(work);
  if (!poles) return work.warn("no usable pair of poles");
  CurvilinearResult found;
  try {
    found = map_curvilinear(work.mesh, work.topology, *poles, {.threads = work.options.threads},
                            work.options.progress);
  } catch (const SolveError& error) {  // no area anywhere, or protrusions where doubles underflow
    return work.warn(error.what());
  }
  work.result.poles = poles;
  work.result.date_line = std::move(found.date_line);
  if (found.clamped_weights > 0) {
    work.warn(std::to_string(found.clamped_weights) +
              " weights of degenerate triangles were clamped");
  }
  work.record("curvilinear map", found.map, found.planar_folds);
  const RelaxationOptions relaxation{
      .energy = work.options.energy,
      .sweeps = date_line_sweeps,
      .vertices = rings_around(work.topology, work.result.date_line->path, date_line_rings),
      .pinned = {poles->north, poles->south},
      .threads = work.options.threads,
      .progress = work.options.progress};
  SphereMap relaxed = relax(work.topology, work.source(), found.map, relaxation).map;
  work.record("relaxation", relaxed);
  work.accept("relaxation", std::move(relaxed));
}

void map_progressive(MapInProgress& work) {
  if (!embed(work, {})) work.warn("the progressive embedding ran out of room");
}

void map_by_method(MapInProgress& work) {
  switch (work.options.method) {
    case Method::Paper:
      return map_paper(work);
    case Method::Curvilinear:
      return map_curvilinear(work);
    case Method::Progressive:
      return map_progressive(work);
    case Method::Radial:
      return map_radially(work);
  }
}

Parameterization run(const TriangleMesh& mesh, const Topology& topology,
                     const ParameterizeOptions& options) {
  MapInProgress work(mesh, topology, options);
  map_by_method(work);
  if (options.repair && (options.method != Method::Paper || options.repair_paper)) repair(work);
  if (options.method == Method::Radial) {
    note_movement(work);
  } else if (work.certified()) {
    options.align_to ? align(work) : place_frame(work);
  }
  if (options.method == Method::Paper) warn_of_poles_of_paper(work);
  if (work.certified()) warn_of_balance(work);
  if (work.certified()) warn_of_gap(work);
  if (work.certified()) tell_filler_share(work);
  return std::move(work.result);
}

/// Where lengths count, as for steps and sweeps, those of the rays are 1. Others than by rounding,
/// to floats too, are taken off; a ray that is 0 stays.
SphereMap with_unit_rays(SphereMap map) {
  constexpr double rounding = 1e-6;
  for (Vertex v = 0; v < map.points.rows(); ++v) {
    const double length = map.points.row(v).stableNorm();
    if (length > 0 && std::abs(length - 1) > rounding) map.points.row(v) /= length;
  }
  return map;
}

Parameterization run_from(const SphereMap& map, const TriangleMesh& mesh, const Topology& topology,
                          const ParameterizeOptions& options) {
  MapInProgress work(mesh, topology, options);
  work.orientation = map;
  work.accept("given map", map);
  repair(work);
  const bool framed = options.poles || options.meridian || !options.pins.empty();
  if (work.certified() && framed) place_frame(work);
  if (work.certified() && options.align_to) align(work);
  if (work.certified()) warn_of_gap(work);
  if (work.certified()) tell_filler_share(work);
  return std::move(work.result);
}

}  // namespace

Parameterization parameterize(const TriangleMesh& mesh, const ParameterizeOptions& options) {
  require_domain(mesh, options);
  report(options.progress, "topology", 0);
  Parameterization result = run(mesh, require_sphere(mesh, options.threads), options);
  give_back_freed_memory();  // before the caller writes the map
  return result;
}

Parameterization parameterize(const TriangleMesh& mesh, const Topology& topology,
                              const ParameterizeOptions& options) {
  require_domain(mesh, options);
  require_sphere(mesh, topology);
  Parameterization result = run(mesh, topology, options);
  give_back_freed_memory();
  return result;
}

Parameterization repair_map(const TriangleMesh& mesh, const SphereMap& map,
                            const ParameterizeOptions& options) {
  if (map.points.rows() != mesh.vertex_count() || !map.points.allFinite()) {
    throw std::invalid_argument("repair_map: one finite ray a vertex is needed");
  }
  require_domain(mesh, options);
  ParameterizeOptions given = options;
  given.automatic_poles = false;
  return run_from(with_unit_rays(map), mesh, require_sphere(mesh, options.threads), given);
}

}  // namespace sphparam
