#pragma once

#include "sphparam/baselines/baseline_result.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"

namespace sphparam {

struct TangentialOptions {
  /// The operator 𝓛: mean value weights (the paper's Figure 7), or all equal (Alexa).
  enum class Operator { MeanValue, Uniform } laplacian = Operator::MeanValue;
  int max_sweeps = 10000;        // ≥ 0
  int sweeps_per_anchors = 500;  // at most, before other anchors are taken; ≥ 1
  double rest = 1e-6;            // ≥ 0, radians: a map whose vertices all move less has settled
  int threads = 0;               // of the weights; 0: all cores
};

/// Tangential Laplacian smoothing with back projection onto the sphere, after Alexa, "Merging
/// polyhedral shapes with scattered features" (2000), and Kobbelt, Vorsatz, Labsik, Seidel, "A
/// shrink wrapping approach to remeshing polygonal surfaces" (1999): the paper's references [1,
/// 13].
///
/// Starts from the central projection. Four anchors, the vertices nearest to the corners of a
/// tetrahedron, are held so that the mesh does not slip over the sphere; they are released for four
/// others when the map has settled or `sweeps_per_anchors` are over. Ends by Alexa's rule, when no
/// triangle is folded then; a map without folds that more sweeps would fold again is the result as
/// well: it has begun to slip. Else the end is at `max_sweeps`, or when the map rests, folded, with
/// four sets of anchors.
/// The order of the sweeps (Gauss–Seidel, by index), the tetrahedra and the numbers are ours.
/// Ensures: same bits for any number of threads. Requires: closed genus-0 mesh.
/// Throws: Cancelled. Cost: about 0.02 µs a triangle and sweep, on one thread.
BaselineResult map_tangential(const TriangleMesh& mesh, const Topology& topology,
                              const TangentialOptions& options = {}, const Progress& progress = {});

}  // namespace sphparam
