#pragma once

#include <cstdint>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/progress.h"

namespace sphparam {

/// λ of the map under which a grid's vertices are spread best: area counts more than in maps to
/// look at, since what has few vertices is far from its source. Evidence:
/// tests/bench/sampling_study (19 real meshes on four grids, 3 made ones on two): the least RMS
/// distance in the geometric mean, 0.79 to 0.84 of what λ = 1 has and at worst 1.07; 3 to 10 are
/// hardly different.
constexpr double remeshing_lambda = 5;

struct AdaptationOptions {
  double lambda = remeshing_lambda;  // > 0, at most `greatest_lambda`
  int threads = 0;                   // 0: all cores
  Progress progress = {};
};

/// A mesh whose map gives more of the sphere to what bends more.
struct Adaptation {
  MappedMesh mapped;
  int steps = 0;  // 0: the map has triangles so thin that none may be moved safely; it is as given
  double least_density = 1, greatest_density = 1;  // of vertices, relative to the mean
};

/// Relaxes a map so that a grid of `samples` vertices has them where they do most good: where the
/// surface bends, with curvature at the grid's scale to the power 0.8.
/// Ensures: one-to-one as before; the same bits for any number of threads; what is remeshed from it
/// tells so in its provenance.
/// Throws: std::invalid_argument for less than a sample and for an option outside of its domain,
/// before any work; SolveError as `measure_curvature`; NotCertifiedError; Cancelled.
/// Source: our own; tests/bench/sampling_study. Cost: some ten steps of `optimise`.
Adaptation adapt_map(const MappedMesh& source, std::int64_t samples,
                     const AdaptationOptions& options = {});

/// Whether a map was made by `adapt_map`.
bool is_adapted(const MappedMesh& mapped);

}  // namespace sphparam
