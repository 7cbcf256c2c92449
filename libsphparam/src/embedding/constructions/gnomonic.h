#pragma once

#include <optional>

#include "embedding/constructions/untangle.h"
#include "embedding/sweeps/relaxation.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

/// A mesh without one vertex, embedded in a disk around 0 of the plane.
struct OneVertexDisk {
  Vertex south;                // the vertex left out; its row is 0
  RowTable<double, 2> points;  // #V×2
};

/// The vertex in the middle of the mesh: the one whose greater distance to the two ends of a
/// longest path is least, counted in edges. Left out of the disk, it leaves every protrusion as
/// short as can be: a planar image shrinks by e^(−π·length/width) along a protrusion. Our own.
/// Cost: four breadth-first searches.
Vertex middle_vertex(const Topology& topology);

/// Tutte's embedding of the mesh without `south`: the link of `south` on the unit circle, gaps half
/// even and half by edge length (so below 5π/6), the rest by symmetrised mean value weights.
///
/// Ensures: in exact arithmetic the disk is one-to-one, counter-clockwise seen from +z, 0 strictly
///          inside the link's polygon. In doubles, protrusions longer than some 5 circumferences
///          collapse.
/// Paper: Tutte 1963; Floater, "One-to-one piecewise linear mappings over triangulations" (2003).
/// Requires: closed genus-0 mesh. Throws: SolveError. Cost: one sparse Cholesky factorisation.
OneVertexDisk tutte_disk(const TriangleMesh& mesh, const Topology& topology, Vertex south,
                         int threads = 0);

/// Rays (ρu, ρv, 1), and (0, 0, −1) for the vertex left out.
///
/// det((u₁,v₁,1), (u₂,v₂,1), (u₃,v₃,1)) is twice the signed area: the map is one-to-one exactly
/// where the disk is. All but the star of `south` lies in the northern half.
/// areas: weight of each vertex; ρ > 0 spreads them evenly over that half. Our own.
SphereMap gnomonic_lift(const OneVertexDisk& disk, const VectorX& areas);

/// The inverse of the stereographic projection, the disk first moved and scaled so that the
/// weighted mean of the points lies near the centre. Conformal where the disk is, so its
/// protrusions are far less crowded than a gnomonic lift's; but a wide triangle may fold.
SphereMap stereographic_lift(const OneVertexDisk& disk, const VectorX& areas);

/// A third of the source area of the triangles at each vertex. Shapes: #V.
VectorX vertex_areas(const Topology& topology, const RestTriangles& source);

struct GnomonicOptions {
  std::optional<Vertex> south = {};  // the vertex left out; chosen automatically if not given
  double lambda = 1;                 // area against angle, see DistortionEnergy
  int reweightings = 4;  // ≥ 0: more solves, κ drawing the areas towards the source's
  int sweeps = 30;       // ≥ 0: of guarded relaxation at the end
  int threads = 0;       // 0: all cores
  Progress progress = {};
};

struct GnomonicReport {
  Vertex south = -1;
  bool stereographic = false;  // which lift the map came from
  int reweightings = 0;        // kept
  long lift_folds = 0;         // of the lift that was kept, before untangling
  int attempts = 0;            // vertices left out in turn
  UntangleReport untangling;
  RelaxationReport relaxation;
};

struct GnomonicEmbedding {
  SphereMap map;
  bool bijective = false;  // certified before the relaxation, which keeps it so
  GnomonicReport report;
};

/// Embeds a mesh from nothing: no poles, no date line, any connectivity.
///
/// A vertex is left out (the middle one; then the one of largest valence, then the ends of a
/// longest path, until a map is certified). Its disk is lifted stereographically and, while that
/// adds no folds, solved again with κ ← κ·√(image area / source area) per triangle, the paper's
/// weights accumulated (Section 5); the least E is kept. Folds are untangled; failing that, the
/// gnomonic lift takes over, which cannot fold but for rounding. Last, guarded relaxation. Ensures:
/// same bits for any number of threads. Requires: closed genus-0 mesh. Throws: SolveError;
/// Cancelled; std::invalid_argument naming an option outside of its domain. Cost: 2 +
/// `reweightings` factorisations, typically.
GnomonicEmbedding gnomonic_embedding(const TriangleMesh& mesh, const Topology& topology,
                                     const GnomonicOptions& options = {});

}  // namespace sphparam
