#pragma once

#include "level_set.h"

namespace sphparam::samples {

struct SurfaceRelaxationOptions {
  int rounds = 20;
  double step = 0.5;         // share of the way to the ring's centre
  double difference = 1e-4;  // for gradients of the field
};

/// Makes triangles alike: in each round edges are flipped towards Delaunay, and every vertex moves
/// along the surface field = 0 towards the centre of its ring. The topology stays what it is.
///
/// Requires: a closed manifold near the surface.
/// Ensures: the same bits for any number of threads.
TriangleMesh relaxed_on_surface(const TriangleMesh& mesh, const Field& field,
                                const SurfaceRelaxationOptions& options = {});

}  // namespace sphparam::samples
