#pragma once

#include "sphparam/baselines/baseline_result.h"
#include "sphparam/mesh/edge_weights.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"

namespace sphparam {

struct HemispheresOptions {
  /// Or Cotangent, which may be negative and then fold triangles. Requires: a symmetric kind.
  WeightKind weights = WeightKind::SymmetricMeanValue;
  int max_sweeps = 100;     // ≥ 0, of projected Gauss–Seidel; fewer where the residual rises
  int max_steps = 30;       // ≥ 0, of Newton
  double tolerance = 1e-8;  // ≥ 0; residual of the equations, of what it is for the two hemispheres
  int threads = 0;          // 0: all cores
};

/// Two hemispheres, then Tutte's equations on the sphere: Saba, Yavneh, Gotsman, Sheffer,
/// "Practical spherical embedding of manifold triangle meshes" (2005), the paper's reference [17].
///
/// The mesh is bisected by a closed path of edges, each half is mapped to the unit disk (Tutte,
/// Floater), its rim to the circle by arc length, and by inverse stereographic projection to a
/// hemisphere. Then Σ_j w_ij x_j = α_i x_i, |x_i| = 1 is solved: sweeps of projected Gauss–Seidel
/// as long as the residual falls (after that they slip and collapse), then Newton's method.
/// Ours: the weights are symmetrised mean values; the bisection is by a harmonic function between
/// two far vertices, where they cut a graph; Newton's systems are solved directly, where they use
/// multigrid, its steps are damped by line search on the residual, and the Möbius freedom is taken
/// out: the equations are solved up to a force of a Möbius field times area (see
/// src/baselines/tutte_equations.cpp), without which Newton's method runs away along it.
/// Ensures: same bits for any number of threads. Requires: closed genus-0 mesh.
/// Throws: Cancelled. Cost: a factorisation of #V unknowns, and one of 2·#V a Newton step.
BaselineResult map_hemispheres(const TriangleMesh& mesh, const Topology& topology,
                               const HemispheresOptions& options = {},
                               const Progress& progress = {});

/// The two faces' sets of a bisection. Side per face: 0 or 1; both are disks, and their numbers of
/// faces differ by at most one. The seam is their common boundary, side 0 on its left.
struct Bisection {
  std::vector<char> side;    // #F
  std::vector<Vertex> seam;  // a simple closed path of edges
};

/// Cuts a mesh into two disks of as many faces each, along a level of a harmonic function between
/// two far vertices. Requires: closed genus-0 mesh. Throws: SolveError. Cost: one factorisation,
/// O(#F log #F).
Bisection bisect(const TriangleMesh& mesh, const Topology& topology, int threads = 0);

/// The start of the method: each half on its hemisphere, side 0 north, the seam on the equator.
/// Throws: SolveError.
SphereMap place_hemispheres(const TriangleMesh& mesh, const Topology& topology,
                            const Bisection& bisection, int threads = 0);

}  // namespace sphparam
