#pragma once

#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// Curvature at the vertices, averaged over a stated distance. Positive where the surface is
/// convex.
struct Curvature {
  VectorX mean;      // #V: H = (κ₁ + κ₂)/2, in 1/length of the mesh
  VectorX gauss;     // #V: K = κ₁·κ₂, in 1/length²
  VectorX area;      // #V: a third of the triangles at the vertex, floored at 1e-9 of the mean
  double scale = 0;  // of the average, as asked for
};

/// Mean and Gauss curvature of a closed mesh as densities of its curvature measures.
///
/// The measures live on edges (½ · dihedral angle · length) and on vertices (2π less the angles),
/// where slivers do no harm: both are bounded whatever the shape of the triangles. A triangle
/// without area is a piece of the one across its longest side. Half of an edge's goes to each end;
/// divided by the area they are curvatures at `scale` 0. A larger scale averages both over
/// neighbours, with standard deviation `scale` in each direction of the surface, by one implicit
/// step of heat flow with positive weights: the result stays between the extremes, and what is
/// small beside `scale` averages away.
/// Fillers are no surface: their area counts for nothing. Vertices of rims have the curvature of
/// their neighbours inside the surface; those that only fillers use have none: 0 at scale 0.
/// Requires: finite positions; scale is a length; a mark a face, or none at all. Where a figure is
/// beyond the doubles it is the nearest of them: 0, or the largest.
/// Ensures: without fillers Σ area · gauss = 2π · χ (4π for genus 0), Σ area · mean =
///          ½ Σ angle · length, up to rounding, or 1e-8 of Σ |…| with a scale; finite. Same bits
///          for any number of threads.
/// Throws: SolveError if the average cannot be found; std::invalid_argument unless 0 ≤ scale < ∞.
/// Source: measures: Cohen-Steiner and Morvan,
/// "Restricted Delaunay triangulations and normal cycle" (2003); the average: our own.
/// Cost: two passes; with a scale about 0.1 µs a vertex and edge length that it spans, and a sparse
/// matrix, 100 bytes a vertex.
Curvature measure_curvature(const TriangleMesh& mesh, const Topology& topology, double scale = 0,
                            int threads = 0, const FillerMarks& fillers = {});

/// √(A / 4π), the radius of the sphere of the mesh's area: a length to state scales in. The
/// largest double where it is beyond them.
double equal_area_radius(const TriangleMesh& mesh, int threads = 0);

}  // namespace sphparam
