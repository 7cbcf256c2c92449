#pragma once

#include "embedding/sweeps/relaxation.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

struct GridLiftOptions {
  DistortionEnergy energy = {};  // of the relaxation
  int sweeps = 10;               // ≥ 0: of guarded relaxation at the end
  int threads = 0;               // 0: all cores
  Progress progress = {};
};

struct GridLiftReport {
  Vertex south = -1;  // the vertex whose star covers more than half of the sphere at first
  int attempts = 0;   // vertices tried as `south`
  bool unit = false;  // false: rounding to unit length would fold, the rays are integers
  RelaxationReport relaxation;
};

struct GridLift {
  SphereMap map;
  bool bijective = false;  // proved, exactly; false only if no room was found for any south
  GridLiftReport report;
};

/// Embeds a mesh by integers alone: a last resort that no shape can break. Distortion is high.
///
/// A vertex of valence five or less is left out, its hole filled with triangles, the rest drawn
/// inside one of these on an integer grid whose faces are weighted by source area. The grid's rays
/// have exactly positive determinants. The vertex returns opposite to a point that sees the whole
/// hole: a polygon of five corners always has one. No vertex is added, no linear system solved.
/// Ensures: same bits for any number of threads; points of unit length where `unit`.
/// Requires: closed genus-0 mesh. Cost: O(#F); 0.5 µs a triangle, and 0.14 µs a sweep.
/// Our own, after Schnyder (see planar_drawing.h) and the last step of Fáry's theorem.
GridLift grid_lift(const TriangleMesh& mesh, const Topology& topology,
                   const GridLiftOptions& options = {});

}  // namespace sphparam
