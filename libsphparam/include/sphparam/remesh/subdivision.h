#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/progress.h"
#include "sphparam/remesh/limit_surface.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

/// "loop", "catmark".
std::string name_of(Scheme scheme);

/// A grid that no surface of the scheme wanted can be fitted on, and why.
class UnfittableGrid : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// More of them on a patch would be some gigabytes each.
constexpr int most_samples_along_edge = 1024;

struct SubdivisionFitOptions {
  Scheme scheme = Scheme::Loop;
  /// n² samples on each patch; 0: as many as the source has triangles, 4² to 16² a patch.
  int samples_along_edge = 0;  // at most `most_samples_along_edge`
  /// How often samples look for the point of the source that they have come to lie nearest to.
  int rounds = 3;           // ≥ 0
  double reduction = 1e-2;  // of the last round's residual, by conjugate gradients; in (0, 1)
  int threads = 0;          // 0: all cores
  Progress progress = {};
};

/// A limit surface fitted to a mesh.
struct SubdivisionFit {
  std::shared_ptr<const LimitTopology> topology;
  Points control;  // a point a vertex of the grid

  std::int64_t samples = 0;
  double rms = 0, max = 0;  // from the samples on the limit to the source; rms over its area
  /// Both ways, of the surface and of the grid's own flat faces; 0 before `compare_with_flat`.
  double two_sided_rms = 0, flat_rms = 0;
  /// A smooth surface on too few control points is farther from a mesh than flat faces on them.
  bool flat_is_nearer() const { return two_sided_rms > flat_rms; }
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
/// Ensures: the same bytes for any number of threads.
/// Throws: std::invalid_argument for an option outside of its domain; UnfittableGrid for faces that
/// are not for the scheme, and for vertices with more faces than LimitTopology takes;
/// UnmeasurableMesh as `require_measurable`; SolveError; Cancelled. Cost: about 3 µs a sample and
/// round, one thread.
SubdivisionFit fit_subdivision(const MappedMesh& source, const SphereGrid& grid,
                               const SubdivisionFitOptions& options = {});

/// Measures how far the surface fitted to a mesh and the flat faces on the same grid are from it.
/// Of the options, threads and progress count. Throws: UnmeasurableMesh where nothing of the mesh's
/// area is left on the grid; Cancelled. Cost: about 0.3 s.
void compare_with_flat(SubdivisionFit& fit, const MappedMesh& source, const Remeshed& flat,
                       const SubdivisionFitOptions& options = {});

/// The control mesh: the mesh on the grid that was fitted on, with the control points as its
/// positions and the limit's normals and curvatures at its vertices as the properties nx ny nz,
/// mean_curvature and gauss_curvature. Its provenance names the scheme.
Remeshed control_mesh(const Remeshed& flat, const SubdivisionFit& fit, int threads = 0);

/// A control mesh with its vertices moved to the limit surface.
Remeshed limit_mesh(const Remeshed& control, const SubdivisionFit& fit, int threads = 0);

/// Triangles that show a fitted limit surface: its patches cut into `pieces` pieces or more.
/// Requires: `faces` are those the surface was fitted on. Throws: std::invalid_argument for more
/// corners than an index can number. Ensures: the same bytes for any number of threads.
TriangleMesh fine_limit_mesh(const SubdivisionFit& fit, const Polygons& faces, std::int64_t pieces,
                             int threads = 0);

}  // namespace sphparam
