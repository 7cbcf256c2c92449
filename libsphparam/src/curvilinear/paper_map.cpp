#include "curvilinear/paper_map.h"

#include "curvilinear/harmonic.h"
#include "curvilinear/lift.h"
#include "curvilinear/quasi_harmonic.h"
#include "option_domain.h"
#include "sphparam/stopwatch.h"

// (M, poles) → date line → disk → (θ, ϕ) → κ → (θ, ϕ) → … → sphere → smoothing, as in Figure 1.

namespace sphparam {
namespace {

void require_domain(const PaperOptions& options, Poles poles, Eigen::Index vertices) {
  require_more_than("epsilon", options.epsilon, 0);
  require_between("epsilon", options.epsilon, 0, greatest_epsilon);
  require_at_least("iterations", options.iterations, 0);
  require_at_least("rings", options.rings, 0);
  require_at_least("sweeps", options.sweeps, 0);
  require_one_of("weights", options.weights, WeightKind::SymmetricMeanValue);
  require_vertex("poles.north", poles.north, vertices);
  require_vertex("poles.south", poles.south, vertices);
}

}  // namespace

PaperResult map_as_paper(const TriangleMesh& mesh, const Topology& topology, Poles poles,
                         const PaperOptions& options, const Progress& progress,
                         const StageObserver& on_stage) {
  require_domain(options, poles, mesh.vertex_count());
  PaperResult result;
  Stopwatch watch;
  report(progress, "date line", 0);
  result.date_line = shortest_date_line(mesh, topology, poles);
  const CutMesh cut_mesh(topology, result.date_line);
  result.path_seconds = watch.lap();

  long folds = 0;
  const auto finish_stage = [&](std::string name) {
    result.stages.push_back({std::move(name), watch.lap(), folds});
    if (on_stage) on_stage(result.stages.back(), result.map);
    watch.lap();
  };

  report(progress, "initial map", 0);
  const EdgeWeights weights(mesh, topology, options.weights, options.threads);
  HarmonicSolver solver(topology, cut_mesh, rectangle_boundary(mesh, cut_mesh, options.epsilon),
                        weights.symmetric(), options.threads);
  for (int iteration = 0; iteration <= options.iterations; ++iteration) {
    report(progress, "secondary map", double(iteration) / (options.iterations + 1));
    std::vector<double> kappa;  // empty, all 1, for the initial map
    if (iteration > 0) kappa = area_distortion(mesh, result.map, options.threads);
    const CurvilinearMap chart =
        solver.solve(weights.with(topology, kappa, options.threads), options.threads);
    result.map = lift(cut_mesh, chart, options.threads);
    folds = planar_folds(topology, cut_mesh, chart, options.threads);
    finish_stage(iteration == 0 ? "initial" : "iteration " + std::to_string(iteration));
  }

  report(progress, "smoothing", 0);
  result.map = smooth_date_line(
      mesh, topology, result.date_line, std::move(result.map),
      {.rings = options.rings, .sweeps = options.sweeps, .threads = options.threads});
  finish_stage("smoothing");
  return result;
}

}  // namespace sphparam
