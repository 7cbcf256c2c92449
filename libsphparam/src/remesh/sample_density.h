#pragma once

#include <cstdint>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

/// λ of the map under which a grid's vertices are spread best: area counts more than in maps to
/// look at, since what has few vertices is far from its source. Evidence:
/// tests/bench/sampling_study (19 real meshes on four grids, 3 made ones on two): the least RMS
/// distance in the geometric mean, 0.79 to 0.84 of what λ = 1 has and at worst 1.07; 3 to 10 are
/// hardly different.
constexpr double remeshing_lambda = 5;

/// Where `samples` vertices of a grid do most good: vertices per area of the surface, at each
/// vertex of the mesh, relative to their mean.
///
/// Grows with the curvature κ = √((κ₁² + κ₂²)/2), taken at the scale of the grid: what bends more
/// than the grid can follow counts as bent that much. A share is spread evenly, so that the ratio
/// of densities is bounded, whatever the surface does. A triangle of size h is some κh² away from
/// the surface: κ^{2/3} vertices per area have the least RMS distance, κ of them the same distance
/// everywhere. κ^0.8 is measured to lower both, on each of 22 shapes: to 0.55 and 0.45 of what
/// λ = 1 has without, in the geometric mean.
///
/// Requires: positions finite; samples ≥ 1. Ensures: positive and finite; does not depend on the
/// mesh's size; same bits for any number of threads. Throws: SolveError as `measure_curvature`.
/// Source: our own. Cost: that of `measure_curvature`.
VectorX sample_density(const TriangleMesh& mesh, const Topology& topology, std::int64_t samples,
                       int threads = 0);

struct AdaptationOptions {
  double lambda = remeshing_lambda;
  int threads = 0;
  Progress progress = {};
};

struct Adaptation {
  SphereMap map;
  int steps = 0;  // 0: the map has triangles so thin that none may be moved safely; it is as given
  double least_density = 1, greatest_density = 1;  // relative to the mean
};

/// Relaxes a map so that a grid of `samples` vertices has them where `sample_density` wants them.
/// Requires: unit rays, certified one-to-one. Ensures: no orientation is lost, by the guard of
/// `optimise`; same bits for any number of threads. Throws: as `sample_density`; Cancelled.
/// Cost: some ten steps of `optimise`.
Adaptation adapt_map(const TriangleMesh& mesh, const Topology& topology, const SphereMap& map,
                     std::int64_t samples, const AdaptationOptions& options = {});

}  // namespace sphparam
