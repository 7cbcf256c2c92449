#pragma once

#include <memory>
#include <vector>

#include "remesh/limit_surface.h"
#include "remesh/sphere_grid.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

struct SubdivisionFitOptions {
  Scheme scheme = Scheme::Loop;
  /// n² samples on each patch; 0: as many as the source has triangles, 4² to 16² a patch.
  int samples_along_edge = 0;
  /// How often samples look for the point of the source that they have come to lie nearest to.
  int rounds = 3;
  double reduction = 1e-2;  // of the last round's residual, by conjugate gradients
  int threads = 0;
  Progress progress = {};
};

/// A limit surface fitted to a mesh.
struct SubdivisionFit {
  std::shared_ptr<const LimitTopology> topology;
  Points control;  // a point a vertex of the grid

  std::int64_t samples = 0;
  double rms = 0, max = 0;  // from the samples on the limit to the source; rms over its area
  /// Where the caller measured them: of the surface and of the grid's own flat faces.
  double two_sided_rms = 0, flat_rms = 0;
  double rms_in_place = 0;  // to the points of the source in the samples' directions, first round
  std::vector<int> steps;   // of conjugate gradients, a round
  int thin_vertices = 0;    // which samples alone would hardly hold
  double sampling_seconds = 0, solving_seconds = 0, projecting_seconds = 0;
};

/// Finds control points, one a vertex of a grid, whose limit surface comes nearest to a mapped mesh
/// in the sense of least squares.
///
/// Samples lie at the same places of every patch. Place (s, t) stands for the direction of the
/// limit point there when the grid's directions are the control points, which turns smoothly also
/// across edges; its target is the source's point in that direction, its weight the source's area
/// that it stands for. The first round draws limit points to their targets. In the rounds that
/// follow, the target is the source's point nearest to the limit point (where both surfaces face
/// the same side), and a limit point may slide along the surface at 3/100 of the price: control
/// points are spent on the shape rather than on where on it a parameter lies.
/// A mesh that is crumpled far more finely than the grid has no smooth surface near it: the fit is
/// then its mean, which may be farther from it than a flat mesh of points picked from it.
/// Source: our own of known parts. Least squares on limit stencils: Hoppe et al., "Piecewise smooth
/// surface reconstruction" (1994); damped sliding: Wang, Pottmann, Liu, "Fitting B-spline curves to
/// point clouds by curvature-based squared distance minimization" (2006).
/// Requires: unit rays, certified one-to-one. Ensures: the same bytes for any number of threads.
/// Throws: std::invalid_argument as LimitTopology does; Cancelled; SolveError.
/// Cost: about 3 µs a sample and round, one thread.
SubdivisionFit fit_subdivision(const TriangleMesh& source, const SphereMap& map,
                               const SphereGrid& grid, const SubdivisionFitOptions& options = {});

/// Where the vertices of a grid lie on its limit surface.
struct LimitVertices {
  Points positions, normals;  // unit, outwards
  VectorX mean, gauss;        // curvature: of a sphere of radius r, 1/r and 1/r²
};

/// Normals and curvatures are means over the patches about a vertex, which agree where the valence
/// is the usual one (6 by Loop's scheme, 4 by Catmull's and Clark's): there they are exact. At
/// other vertices the schemes have no curvature, or an infinite one; that of the patches half way
/// between the vertex and their middles is taken.
LimitVertices limit_at_vertices(const LimitSurface& surface, const Polygons& faces,
                                int threads = 0);

}  // namespace sphparam
